// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/honeycomb_map.hpp"
#include "hexact/kernel/polygon_soup.hpp"

#include <span>
#include <vector>

namespace hexact {

/// Measures of one level, in floating point and for information: nothing is decided by them. Lengths are those of
/// the points, angles are degrees between the outward normals of adjacent facets, 0 where the surface is flat.
struct HoneycombStatistics {
  double max_normal_angle_deg = 0;
  double median_normal_angle_deg = 0;  ///< the lower median over all edges
  double longest_edge = 0;
  double shortest_edge = 0;
  double max_facet_diameter = 0;  ///< largest distance between two corners of one facet
};

/// Measures a level. `unit_normals` holds one outward normal per facet; take them from the planes where there are
/// any: small angles cannot be had from rounded points. Cost: linear, in parallel; the result does not depend on the
/// number of threads.
[[nodiscard]] HoneycombStatistics measure(const HoneycombMap& map, std::span<const Point3<double>> points,
                                          std::span<const Point3<double>> unit_normals);

/// Unit normals from the points, by Newell's sum.
[[nodiscard]] std::vector<Point3<double>> newell_normals(const HoneycombMap& map, std::span<const Point3<double>> points);

}  // namespace hexact
