// SPDX-License-Identifier: GPL-3.0-or-later
#include "midedge_limit_output.hpp"

#include "hexact/io/output_file.hpp"
#include "hexact/kernel/parallel.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>

namespace hexact::app {
namespace {

using Limits = std::vector<std::optional<MidedgeLimit>>;

/// Limits of facets first … first + count − 1.
Limits limits_of(const MidedgeLevel<Rational>& level, const LimitPlan& plan, std::uint32_t first, std::size_t count) {
  const MidedgeLevel<Rational> isolated =
      isolate_facets(level, plan.rule, plan.boundary, first + count, plan.most_facets);
  MidedgeLimits limit(plan.rule);
  for (std::uint32_t f = first; f < first + count; ++f) limit.prepare(isolated.map.facet_size(f));
  Limits result(count);
  for_ranges(count, 16, [&](std::uint32_t begin, std::uint32_t end) {
    for (std::uint32_t i = begin; i != end; ++i) result[i] = limit(isolated, first + i);
  });
  return result;
}

nlohmann::ordered_json strings(const Point3<Rational>& p) { return {p.x.str(), p.y.str(), p.z.str()}; }

nlohmann::ordered_json entry(const MidedgeMap& map, std::uint32_t f, const std::optional<MidedgeLimit>& limit) {
  const FacetAddress address = map.address(f);
  nlohmann::ordered_json out;
  out["facet"] = f;
  out["level"] = address.level;
  out["parent"] = address.parent ? nlohmann::ordered_json(index(*address.parent)) : nlohmann::ordered_json();
  for (const char* key : {"point", "plane", "bound"}) out[key] = nullptr;
  if (!limit) return out;
  const Point3<double> p{limit->point.x.to_double(), limit->point.y.to_double(), limit->point.z.to_double()};
  const auto off = [](const Rational& x, double y) { return abs(x - Rational::from_double(y)); };
  const Rational distance = off(limit->point.x, p.x) + off(limit->point.y, p.y) + off(limit->point.z, p.z);
  out["point"] = {p.x, p.y, p.z};
  out["bound"] = distance.is_zero() ? 0.0 : std::nextafter(distance.to_double(), std::numeric_limits<double>::infinity());
  out["exact"] = strings(limit->point);
  if (!limit->normal) return out;
  const Point3<double>& n = limit->normal->unit;
  out["plane"] = {n.x, n.y, n.z, n.x * p.x + n.y * p.y + n.z * p.z};
  out["normal_bound"] = limit->normal->bound;
  if (limit->normal->exact) out["exact_normal"] = strings(*limit->normal->exact);
  return out;
}

}  // namespace

void write_midedge_limits(const SubdivideOptions& options, const MidedgeLevel<Rational>& level, const LimitPlan& plan) {
  const Limits limits = limits_of(level, plan, 0, level.map.facet_count());
  nlohmann::ordered_json document = {{"hexact", "limit-points"}, {"version", 1}};
  document["scheme"] = options.scheme;
  document["level"] = level.map.level();
  document["arithmetic"] = options.arithmetic;
  document["proved"] = true;
  nlohmann::ordered_json& facets = document["facets"] = nlohmann::ordered_json::array();
  for (std::uint32_t f = 0; f < limits.size(); ++f) facets.push_back(entry(level.map, f, limits[f]));
  io::write_file(options.limit_points, document.dump(1) + "\n");
}

std::vector<Point3<Rational>> midedge_vertex_limits(const MidedgeLevel<Rational>& level, const LimitPlan& plan) {
  for (std::uint32_t h = 0; h < level.map.half_edge_count(); ++h) {
    if (level.map.twin(h) != kNoTwin) continue;
    throw InvalidInput("HasBoundary", "has a facet on one side only: the limits of boundary vertices are not known",
                       edge_name(level.map.origin(h), level.map.target(h)));
  }
  const auto first = static_cast<std::uint32_t>(level.map.facet_count());
  const MidedgeLevel<Rational> next = midedge_step(level, plan.rule, MidedgeBoundary::close);
  std::vector<Point3<Rational>> points;
  for (auto& limit : limits_of(next, plan, first, level.map.vertex_count())) {
    HEXACT_INVARIANT(limit.has_value());
    points.push_back(std::move(limit->point));
  }
  return points;
}

}  // namespace hexact::app
