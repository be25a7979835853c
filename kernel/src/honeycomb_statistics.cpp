// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/kernel/honeycomb_statistics.hpp"

#include "surface_statistics_impl.hpp"

namespace hexact {

HoneycombStatistics measure(const HoneycombMap& map, std::span<const Point3<double>> points,
                            std::span<const Point3<double>> unit_normals) {
  return surface::measure(map, points, unit_normals);
}

std::vector<Point3<double>> newell_normals(const HoneycombMap& map, std::span<const Point3<double>> points) {
  return surface::newell_normals(map, points);
}

}  // namespace hexact
