// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/chamfer.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace hexact::detail {

/// A linear function of the lifts: base + Σ weight[i]·τ(edge[i]).
struct LiftForm {
  std::array<std::uint32_t, 3> edge;
  std::array<double, 3> weight;
  double base = 0;

  [[nodiscard]] double value(const std::vector<double>& lifts) const {
    return base + weight[0] * lifts[edge[0]] + weight[1] * lifts[edge[1]] + weight[2] * lifts[edge[2]];
  }
};

/// Length of a new edge as a function of the lifts, and the angle across it, which does not depend on them.
struct NewEdge {
  LiftForm length;
  double angle = 0;
};

/// The edges that a chamfer step makes, two for each half-edge h of the level before: what is left of h in its facet
/// (`sides`), and the edge that goes inward from the corner of h (`spokes`).
struct NewEdges {
  std::vector<NewEdge> sides, spokes;
};

/// Coefficients of all new edges. Cost: linear.
[[nodiscard]] NewEdges new_edges(const ChamferLevel& level, const EdgeNumbering& edges);

}  // namespace hexact::detail
