// SPDX-License-Identifier: GPL-3.0-or-later
#include "limit_points_output.hpp"

#include "geometry_output.hpp"
#include "hexact/exact/limit_points.hpp"
#include "hexact/io/output_file.hpp"

#include <algorithm>
#include <cmath>

namespace hexact::app {
namespace {

/// Means of the corners and distances to the farthest, in floating point: doubles have no exact planes to prove from.
std::vector<LimitPoint> centres(const HoneycombMap& map, const std::vector<Point3<double>>& points) {
  std::vector<LimitPoint> out(map.facet_count());
  for (std::uint32_t f = 0; f < out.size(); ++f) {
    const std::uint32_t start = map.facet_start(f), n = map.facet_size(f);
    Point3<double>& c = out[f].point;
    for (std::uint32_t h = start; h < start + n; ++h) {
      const auto& p = points[map.origin(h)];
      c = {c.x + p.x / n, c.y + p.y / n, c.z + p.z / n};
    }
    for (std::uint32_t h = start; h < start + n; ++h) {
      const auto& p = points[map.origin(h)];
      out[f].radius = std::max(out[f].radius, std::hypot(p.x - c.x, p.y - c.y, p.z - c.z));
    }
  }
  return out;
}

nlohmann::ordered_json facet_entry(const HoneycombMap& map, std::uint32_t f, const LimitPoint& limit, const Point3<double>& normal,
                                   Arithmetic arithmetic) {
  nlohmann::ordered_json entry;
  entry["facet"] = f;
  entry["level"] = map.facet_level(f);
  entry["parent"] = map.facet_level(f) == 0 ? nlohmann::ordered_json() : nlohmann::ordered_json(map.facet_parent(f));
  const auto& p = limit.point;
  entry["point"] = {p.x, p.y, p.z};
  entry["plane"] = {normal.x, normal.y, normal.z, finite_product(normal, p)};
  // Later levels that are snapped have parameters a little above those asked: only the facet itself bounds them.
  const bool as_asked = arithmetic == Arithmetic::rational || arithmetic == Arithmetic::qsqrt5;
  entry["bound"] = as_asked && limit.bound ? *limit.bound : limit.radius;
  entry["bound_unsnapped"] = limit.bound ? nlohmann::ordered_json(*limit.bound) : nlohmann::ordered_json();
  return entry;
}

}  // namespace

void write_limit_points(const std::string& path, const Refinement& refinement, const SubdivideOptions& options,
                        const std::optional<SizePolicy>& policy, const ProgressPart& progress) {
  const HoneycombMap& map = refinement.map();
  const std::vector<LimitPoint> limits = refinement.is_exact() ? limit_points(map, refinement.body(), policy, progress)
                                                               : centres(map, refinement.vertices().points);
  const std::vector<Point3<double>> normals = refinement.normals();
  nlohmann::ordered_json document = {{"hexact", "limit-points"}, {"version", 1}};
  document["level"] = map.level();
  document["arithmetic"] = options.arithmetic;
  document["parameters"] = options.parameters;
  document["proved"] = refinement.is_exact();
  nlohmann::ordered_json& facets = document["facets"] = nlohmann::ordered_json::array();
  for (std::uint32_t f = 0; f < map.facet_count(); ++f) {
    facets.push_back(facet_entry(map, f, limits[f], normals[f], arithmetic_named(options.arithmetic)));
  }
  io::write_file(path, document.dump(1) + "\n");
}

}  // namespace hexact::app
