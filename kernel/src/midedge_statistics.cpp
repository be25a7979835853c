// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/kernel/midedge_statistics.hpp"

#include "surface_statistics_impl.hpp"

#include <cmath>

namespace hexact {

HoneycombStatistics measure(const MidedgeMap& map, std::span<const Point3<double>> points,
                            std::span<const Point3<double>> unit_normals) {
  return surface::measure(map, points, unit_normals);
}

std::vector<Point3<double>> newell_normals(const MidedgeMap& map, std::span<const Point3<double>> points) {
  return surface::newell_normals(map, points);
}

double fanned_volume(const MidedgeMap& map, std::span<const Point3<double>> points, const Point3<double>& origin) {
  using namespace surface;
  const double six_volumes = tbb::parallel_deterministic_reduce(
      Range(0, static_cast<std::uint32_t>(map.facet_count()), kGrain), 0.0,
      [&](const Range& range, double sum) {
        for (std::uint32_t f = range.begin(); f != range.end(); ++f) {
          const auto loop = map.loop(f);
          Vector centre{0, 0, 0}, area{0, 0, 0};
          for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vector p = minus(points[loop[i]], origin);
            const Vector n = cross(p, minus(points[loop[i + 1 < loop.size() ? i + 1 : 0]], origin));
            centre = {centre.x + p.x, centre.y + p.y, centre.z + p.z};
            area = {area.x + n.x, area.y + n.y, area.z + n.z};
          }
          sum += dot(centre, area) / static_cast<double>(loop.size());
        }
        return sum;
      },
      [](double a, double b) { return a + b; });
  return six_volumes / 6;
}

double fanned_area(const MidedgeMap& map, std::span<const Point3<double>> points) {
  using namespace surface;
  const double two_areas = tbb::parallel_deterministic_reduce(
      Range(0, static_cast<std::uint32_t>(map.facet_count()), kGrain), 0.0,
      [&](const Range& range, double sum) {
        for (std::uint32_t f = range.begin(); f != range.end(); ++f) {
          const auto loop = map.loop(f);
          const double share = 1 / static_cast<double>(loop.size());
          Vector mean{0, 0, 0};
          for (const std::uint32_t v : loop) mean = {mean.x + share * points[v].x, mean.y + share * points[v].y, mean.z + share * points[v].z};
          for (std::size_t i = 0; i < loop.size(); ++i) {
            const Vector n = cross(minus(points[loop[i]], mean), minus(points[loop[i + 1 < loop.size() ? i + 1 : 0]], mean));
            sum += std::hypot(n.x, n.y, n.z);
          }
        }
        return sum;
      },
      [](double a, double b) { return a + b; });
  return two_areas / 2;
}

}  // namespace hexact
