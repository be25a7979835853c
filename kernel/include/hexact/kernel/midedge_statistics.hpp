// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/honeycomb_statistics.hpp"
#include "hexact/kernel/midedge_map.hpp"

#include <span>
#include <vector>

namespace hexact {

/// Measures of a level as for honeycombs; boundary edges have lengths and no angle.
[[nodiscard]] HoneycombStatistics measure(const MidedgeMap& map, std::span<const Point3<double>> points,
                                          std::span<const Point3<double>> unit_normals);

/// Unit normals by Newell's sum; (0, 0, 0) for facets without an area.
[[nodiscard]] std::vector<Point3<double>> newell_normals(const MidedgeMap& map, std::span<const Point3<double>> points);

/// Volume inside a closed surface whose facets are fanned from the mean of their corners, positive for facets that are
/// counter-clockwise from outside. In floating point, summed relative to `origin`; the order of the sum is fixed.
[[nodiscard]] double fanned_volume(const MidedgeMap& map, std::span<const Point3<double>> points, const Point3<double>& origin);

/// Area of the facets, fanned from the mean of their corners; independent of the number of threads.
[[nodiscard]] double fanned_area(const MidedgeMap& map, std::span<const Point3<double>> points);

}  // namespace hexact
