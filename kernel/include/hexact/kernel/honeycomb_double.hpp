// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/honeycomb_map.hpp"
#include "hexact/kernel/polygon_soup.hpp"

#include <functional>
#include <span>
#include <variant>
#include <vector>

namespace hexact {

/// A level of a planar honeycomb in floating point: fast, and nothing about it is proved.
struct DoubleLevel {
  HoneycombMap map;
  RawVector<Point3<double>> points;
};

/// λ by the size of the smaller facet beside the edge: entry n for n-gons; larger sizes take the last entry.
using SizeTable = std::vector<double>;
/// λ(a→b) of any half-edge; called from several threads.
using DoubleParameter = std::function<double(const HoneycombMap&, HalfEdgeId)>;

/// One planar honeycomb step in doubles: the vertex of half-edge v→w is where the cut plane of v meets the cut line
/// of w in the facet to the left, Han 2024 eqs. (2)-(5). The parameters must satisfy conditions (1), (8), (10).
/// Plain doubles lose strict convexity at about level 9 to 11 (collapsing edges). Cost: linear, in parallel; the
/// result does not depend on the number of threads.
[[nodiscard]] DoubleLevel double_step(DoubleLevel level, const std::variant<SizeTable, DoubleParameter>& parameters);

}  // namespace hexact
