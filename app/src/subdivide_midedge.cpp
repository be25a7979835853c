// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact_output.hpp"
#include "body_input.hpp"
#include "hexact/exact/midedge.hpp"
#include "hexact/kernel/midedge_counts.hpp"
#include "hexact/kernel/midedge_statistics.hpp"
#include "subdivide.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>

namespace hexact::app {
namespace {

using Clock = std::chrono::steady_clock;

/// How the command line asks to refine.
struct MidedgePlan {
  MidedgeRule rule;
  MidedgeBoundary boundary;
  bool doubled = false;  ///< two steps at a time: an open mesh under `dual`
};

MidedgePlan plan_of(const SubdivideOptions& options, const MidedgeMap& map) {
  MidedgePlan plan{options.scheme == "midedge" ? MidedgeRule::simple : MidedgeRule::six_point, MidedgeBoundary::dual, false};
  if (options.boundary == "close") plan.boundary = MidedgeBoundary::close;
  if (options.boundary == "drop") plan.boundary = MidedgeBoundary::drop;
  plan.doubled = !map.closed() && plan.boundary == MidedgeBoundary::dual;
  if (plan.doubled && options.levels % 2 != 0) {
    throw UsageError(fmt::format("the mesh has a boundary, and --boundary dual makes two steps at a time: --levels {} is odd",
                                 options.levels));
  }
  return plan;
}

Rational in_field(const Rational& x, const Rational*) { return x; }
double in_field(const Rational& x, const double*) { return x.to_double(); }
double in_field(const QuadraticField& x, const double*) { return x.to_double(); }
Rational in_field(const QuadraticField& x, const Rational*) {
  if (!x.is_rational()) throw InvalidInput("FieldNotRational", "the coordinate " + x.str() + " is not rational; use --arithmetic double", "");
  return x.rational_part();
}

double to_double(double x) { return x; }
double to_double(const Rational& x) { return x.to_double(); }

/// Refuses work that would pass the bounds before it starts.
template <class S>
void check_bounds(const MidedgeMap& map, const MidedgePlan& plan, unsigned levels, const Common& common) {
  const MidedgeCounts n = midedge_counts_after(map, levels, plan.boundary);
  if (2 * n.edges >= 4294967295.0) {
    throw ResourceLimit(fmt::format("level {} would have {:.0f} half-edges; at most 4294967294 are possible", levels, 2 * n.edges));
  }
  if (common.max_facets > 0 && n.facets > static_cast<double>(common.max_facets)) {
    throw ResourceLimit(fmt::format("level {} would have {:.0f} facets, --max-facets allows {}", levels, n.facets, common.max_facets));
  }
  // Map and points of the last level and the one before it, loops, addresses and text of the output.
  constexpr double kBytesPerFacet = std::is_same_v<S, double> ? 320 : 1000;
  if (common.max_memory > 0 && n.facets * kBytesPerFacet > static_cast<double>(common.max_memory)) {
    throw ResourceLimit(fmt::format("level {} would need about {:.0f} bytes, --max-memory allows {}", levels,
                                    n.facets * kBytesPerFacet, common.max_memory));
  }
}

template <class S>
std::vector<Point3<double>> rounded_points(const PointArray<S>& points) {
  std::vector<Point3<double>> result(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) result[v] = {to_double(points[v].x), to_double(points[v].y), to_double(points[v].z)};
  return result;
}

template <class S>
nlohmann::ordered_json level_row(const MidedgeLevel<S>& level, double seconds) {
  const MidedgeMap& map = level.map;
  const std::vector<Point3<double>> points = rounded_points<S>(level.points);
  const HoneycombStatistics s = measure(map, points, newell_normals(map, points));
  nlohmann::ordered_json row;
  row["level"] = map.level();
  row["vertices"] = map.vertex_count();
  row["edges"] = map.edge_count();
  row["faces"] = map.facet_count();
  row["seconds"] = seconds;
  row["max_normal_angle_deg"] = s.max_normal_angle_deg;
  row["median_normal_angle_deg"] = s.median_normal_angle_deg;
  row["longest_edge"] = s.longest_edge;
  row["shortest_edge"] = s.shortest_edge;
  row["max_facet_diameter"] = s.max_facet_diameter;
  row["delta"] = nullptr;
  row["volume"] = nullptr;
  if (map.closed()) row["volume"] = fanned_volume(map, points, points.front());
  if (!map.closed()) row["pinched_vertices"] = map.pinched_vertex_count();
  return row;
}

template <class S>
PolygonSoup<S> soup_of(const MidedgeLevel<S>& level, const std::vector<FacetAddress>& base) {
  PolygonSoup<S> soup;
  soup.points.assign(level.points.begin(), level.points.end());
  soup.facets = level.map.loops();
  std::uint32_t before = 0;  // levels that the input already counts
  for (const FacetAddress& address : base) before = std::max(before, address.level);
  for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) {
    soup.addresses.push_back(level.map.address(f));
    FacetAddress& address = soup.addresses.back();
    if (address.parent) {
      address.level += before;
    } else if (f < base.size()) {
      address = base[f];
    }
  }
  return soup;
}

template <class S>
WrittenGeometry write_level(const MidedgeLevel<S>& level, const std::vector<FacetAddress>& base, const std::string& path,
                            const SubdivideOptions& options, const Common& common) {
  const OutputChoice output{path, output_format(path, options.to), {options.color, common.unit}};
  return write_geometry(output, soup_of(level, base));
}

std::string report_text(const nlohmann::ordered_json& report) {
  std::string text = "level   vertices     facets  max angle     median      longest     shortest       volume  seconds\n";
  for (const auto& row : report["levels"]) {
    text += fmt::format("{:>5} {:>10} {:>10} {:>10.4f} {:>10.4f} {:>12.5g} {:>12.5g} {:>12} {:>8.3f}\n", row["level"].get<unsigned>(),
                        row["vertices"].get<std::size_t>(), row["faces"].get<std::size_t>(),
                        row["max_normal_angle_deg"].get<double>(), row["median_normal_angle_deg"].get<double>(),
                        row["longest_edge"].get<double>(), row["shortest_edge"].get<double>(),
                        row["volume"].is_null() ? "-" : fmt::format("{:.6g}", row["volume"].get<double>()),
                        row["seconds"].get<double>());
    const std::size_t pinched = row.value("pinched_vertices", std::size_t{0});
    if (pinched > 0) text += fmt::format("      {} vertices are pinched: the surface touches itself there\n", pinched);
  }
  return text + fmt::format("written to {}\n", report["output"].get<std::string>());
}

template <class S, class Soup>
Outcome refine(const Soup& input, const SubdivideOptions& options, const Common& common) {
  MidedgeLevel<S> level{MidedgeMap(input.facets, input.points.size()), {}};
  const MidedgePlan plan = plan_of(options, level.map);
  check_bounds<S>(level.map, plan, options.levels, common);
  const S* field = nullptr;
  for (const auto& p : input.points) level.points.push_back({in_field(p.x, field), in_field(p.y, field), in_field(p.z, field)});

  nlohmann::ordered_json rows = nlohmann::ordered_json::array({level_row(level, 0)});
  const auto write_too = [&] {
    if (options.all_levels.empty()) return;
    (void)write_level(level, input.addresses, level_path(options.all_levels, level.map.level()), options, common);
  };
  write_too();
  while (level.map.level() < options.levels) {
    // Each level costs about four times the one before.
    common.work.report(0.05 + 0.8 * std::pow(4.0, static_cast<double>(level.map.level()) - options.levels));
    const auto begin = Clock::now();
    level = plan.doubled ? midedge_double_step(level, plan.rule) : midedge_step(level, plan.rule, plan.boundary);
    rows.push_back(level_row(level, std::chrono::duration<double>(Clock::now() - begin).count()));
    write_too();
  }
  if (level.map.pinched_vertex_count() > 0) {
    common.remark(fmt::format("subdivide: --boundary drop made {} pinched vertices: the result is no manifold",
                              level.map.pinched_vertex_count()));
  }
  Outcome outcome;
  outcome.report["scheme"] = options.scheme;
  outcome.report["arithmetic"] = options.arithmetic;
  outcome.report["boundary"] = level.map.closed() ? nlohmann::ordered_json() : nlohmann::ordered_json(options.boundary);
  outcome.report["levels"] = rows;
  outcome.report["output"] = options.output;
  outcome.report["certificate"] = nullptr;
  outcome.report["max_rounding"] = write_level(level, input.addresses, options.output, options, common).max_rounding;
  if (options.output != "-") outcome.text = report_text(outcome.report);
  return outcome;
}

}  // namespace

Outcome subdivide_midedge(const SubdivideOptions& options, const Common& common) {
  if (common.json && options.output == "-") throw UsageError("--json and -o - both need standard output");
  const io::Format format = output_format(options.output, options.to);
  if (format == io::Format::planes && options.arithmetic == "double") {
    throw UsageError("doubles have no exact planes; write a mesh, or use --arithmetic rational");
  }
  if (!options.all_levels.empty()) (void)level_path(options.all_levels, 0);
  const ExactSoup input = exact_soup(io::read_geometry(options.input, named_format(options.from)));
  return std::visit(
      [&](const auto& soup) {
        return options.arithmetic == "rational" ? refine<Rational>(soup, options, common) : refine<double>(soup, options, common);
      },
      input);
}

}  // namespace hexact::app
