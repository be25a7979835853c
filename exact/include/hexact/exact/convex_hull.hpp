// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/quadratic_field.hpp"
#include "hexact/exact/rational.hpp"
#include "hexact/kernel/polygon_soup.hpp"

#include <vector>

namespace hexact {

/// The boundary of the convex hull of points, exactly: coplanar facets are one facet, points inside or on facets
/// and edges are left out, of equal points the first stays. Vertices keep the order of the points; every loop
/// starts at its smallest vertex; facets are ordered by their sorted vertex numbers. So the result depends on the
/// points only.
/// Throws InvalidInput (NotSolid) when all points lie in one plane.
/// Cost: O(n log n) expected sign tests, each in floating point where a proven bound decides it.
template <class S>
[[nodiscard]] PolygonSoup<S> convex_hull(const std::vector<Point3<S>>& points);

extern template PolygonSoup<Rational> convex_hull(const std::vector<Point3<Rational>>&);
extern template PolygonSoup<QuadraticField> convex_hull(const std::vector<Point3<QuadraticField>>&);

}  // namespace hexact
