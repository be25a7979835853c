// SPDX-License-Identifier: GPL-3.0-or-later
#include "midedge_limit_output.hpp"

#include "geometry_output.hpp"
#include "hexact/io/output_file.hpp"

#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <numeric>

namespace hexact::app {
namespace {

nlohmann::ordered_json strings(const Point3<Rational>& p) { return {p.x.str(), p.y.str(), p.z.str()}; }

nlohmann::ordered_json entry(std::uint32_t f, const FacetAddress& address, const std::optional<MidedgeLimit>& limit) {
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
  out["plane"] = {n.x, n.y, n.z, finite_product(n, p)};
  out["normal_bound"] = limit->normal->bound;
  if (limit->normal->exact) out["exact_normal"] = strings(*limit->normal->exact);
  return out;
}

}  // namespace

void write_midedge_limits(const SubdivideOptions& options, const MidedgeLevel<Rational>& level, std::span<const FacetAddress> addresses,
                          const MidedgeLimitPlan& plan, const ProgressPart& progress) {
  std::vector<std::uint32_t> all(level.map.facet_count());
  std::iota(all.begin(), all.end(), 0u);
  const std::vector<std::optional<MidedgeLimit>> limits = midedge_facet_limits(level, plan, all, progress);
  progress.check();
  nlohmann::ordered_json document = {{"hexact", "limit-points"}, {"version", 1}};
  document["scheme"] = options.scheme;
  document["level"] = level.map.level();
  document["arithmetic"] = options.arithmetic;
  document["proved"] = true;
  nlohmann::ordered_json& facets = document["facets"] = nlohmann::ordered_json::array();
  for (std::uint32_t f = 0; f < limits.size(); ++f) facets.push_back(entry(f, addresses[f], limits[f]));
  io::write_file(options.limit_points, document.dump(1) + "\n");
}

}  // namespace hexact::app
