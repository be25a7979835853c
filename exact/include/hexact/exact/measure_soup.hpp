// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/body_from_soup.hpp"

#include <array>
#include <optional>

namespace hexact {

/// Figures of polygons. What is a double here was computed exactly and rounded at the end, or summed from such terms.
struct SoupMeasures {
  bool planar = false;          ///< there are facets, and the corners of each lie exactly in one plane
  double max_nonplanarity = 0;  ///< largest distance of a corner to its facet's area-vector plane through the mean corner
  double area = 0;              ///< sum of the lengths of the facets' area vectors
  std::array<Point3<double>, 2> box{};  ///< smallest and largest coordinates of all points
};

/// Measures facets that have at least 3 corners, all of them existing. The nonplanarity is 0 exactly when all facets are
/// planar. Throws ResourceLimit when a figure is beyond the finite doubles. Cost: linear.
[[nodiscard]] SoupMeasures measure_soup(const PolygonSoup<Rational>& soup);
[[nodiscard]] SoupMeasures measure_soup(const PolygonSoup<QuadraticField>& soup);

/// Whether the polygons bound a convex body, flat edges and straight corners allowed (they are merged first);
/// empty where they bound nothing: an open or empty mesh. Exact.
[[nodiscard]] std::optional<bool> bounds_convex_body(const PolygonSoup<Rational>& soup, const SoupShape& shape);
[[nodiscard]] std::optional<bool> bounds_convex_body(const PolygonSoup<QuadraticField>& soup, const SoupShape& shape);

}  // namespace hexact
