// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/midedge_map.hpp"
#include "hexact/kernel/polygon_soup.hpp"
#include "hexact/kernel/raw_vector.hpp"

#include <span>
#include <type_traits>
#include <vector>

namespace hexact {

/// How the point on an edge AB is made.
enum class MidedgeRule {
  simple,     ///< (A + B)/2: Peters and Reif, "The simplest subdivision scheme for smoothing polyhedra", 1997
  six_point,  ///< 5/16 (A + B) + 3/(16(k−2)) Σ others of the k-gon + 3/(16(m−2)) Σ others of the m-gon beside the edge;
              ///< (A + B)/2 on the boundary: Tan and Cao, J. Zhejiang Univ. (Sci. Ed.) 46(2), 2019, eqs. (6), (9), (10)
};

/// Points in bulk: memory that is not zeroed first where the number type allows it.
template <class S>
using PointArray = std::conditional_t<std::is_trivially_copyable_v<S>, RawVector<Point3<S>>, std::vector<Point3<S>>>;

/// One level over the numbers S: double, or Rational (instantiated in `exact`).
template <class S>
struct MidedgeLevel {
  MidedgeMap map;
  PointArray<S> points;
};

/// The points of a single step: one on each edge, numbered as `MidedgeMap` says. All weights are positive and add up
/// to 1, so straight and flat data stays so. Cost: linear, in parallel; the result does not depend on the number of threads.
template <class S>
[[nodiscard]] PointArray<S> edge_points(const MidedgeMap& map, std::span<const Point3<S>> points, MidedgeRule rule);

/// The points of a double step: one in each corner. At an inner vertex the rule is applied to the points of the two
/// edges of the corner, with the polygons of edge points of the facet and of the vertex; at a boundary vertex it is the
/// middle of the two. Cost: as above.
template <class S>
[[nodiscard]] PointArray<S> corner_points(const MidedgeMap& map, std::span<const Point3<S>> points, MidedgeRule rule);

/// One single step; on open meshes `boundary` is `close` or `drop`. Over exact numbers denominators grow by at most
/// 2^5 a step where all facets are quadrilaterals. Throws ResourceLimit.
template <class S>
[[nodiscard]] MidedgeLevel<S> midedge_step(const MidedgeLevel<S>& level, MidedgeRule rule, MidedgeBoundary boundary);

/// One double step (`MidedgeBoundary::dual`). Throws ResourceLimit.
template <class S>
[[nodiscard]] MidedgeLevel<S> midedge_double_step(const MidedgeLevel<S>& level, MidedgeRule rule);

extern template PointArray<double> edge_points<double>(const MidedgeMap&, std::span<const Point3<double>>, MidedgeRule);
extern template PointArray<double> corner_points<double>(const MidedgeMap&, std::span<const Point3<double>>, MidedgeRule);
extern template MidedgeLevel<double> midedge_step(const MidedgeLevel<double>&, MidedgeRule, MidedgeBoundary);
extern template MidedgeLevel<double> midedge_double_step(const MidedgeLevel<double>&, MidedgeRule);

}  // namespace hexact
