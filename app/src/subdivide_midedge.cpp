// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_input.hpp"
#include "exact_output.hpp"
#include "hexact/exact/midedge.hpp"
#include "hexact/kernel/midedge_counts.hpp"
#include "hexact/kernel/midedge_statistics.hpp"
#include "level_row.hpp"
#include "midedge_limit_output.hpp"
#include "subdivide.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

namespace hexact::app {
namespace {

using Clock = std::chrono::steady_clock;

/// Facets of the further levels that limits may need where --max-facets says nothing.
constexpr std::size_t kMostLimitFacets = 4000000;

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
  if (options.limit) require_vertex_limits(map, plan.boundary);
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

/// Under `drop` an open mesh loses facets at the boundary, and how many is known for one step only.
bool is_known_ahead(const MidedgeMap& map, const MidedgePlan& plan) { return map.closed() || plan.boundary != MidedgeBoundary::drop; }

/// What limits take beyond the last level.
struct LimitNeeds {
  double facets = 0;  ///< at most, of a mesh that further steps make; 0 under `drop`, where it is not known
  double bytes = 0;   ///< about
};

/// `last` are the counts of the last level. Whether facets wait for rings around them is known only on that level; on most
/// meshes some always do.
LimitNeeds limit_needs(const MidedgeMap& map, const MidedgeCounts& last, const MidedgePlan& plan, const SubdivideOptions& options) {
  LimitNeeds needs;
  // A document holds three fractions of some forty digits for each facet, as values and as text.
  if (!options.limit_points.empty()) needs.bytes = 4600 * last.facets;
  if (!is_known_ahead(map, plan) || (options.limit_points.empty() && !options.limit)) return needs;
  unsigned level = options.levels - map.level();
  if (options.limit) {  // the whole mesh once more: vertices become facets
    level += plan.doubled ? 2 : 1;
    needs.facets = midedge_counts_after(map, level, plan.boundary).facets;
    needs.bytes += 1000 * needs.facets;
  }
  if (plan.rule == MidedgeRule::simple && (map.closed() || plan.boundary == MidedgeBoundary::dual)) return needs;
  // Some thousands at a time with two rings, which make 25 of one quadrilateral, and each facet becomes four.
  constexpr double kLargestPart = 4 * 25 * 4096;
  needs.facets = std::max(needs.facets, std::min(kLargestPart, midedge_counts_after(map, level + 2, plan.boundary).facets));
  return needs;
}

/// Refuses work that would pass the bounds, before it starts; under `drop` before each step, as no more is known ahead.
template <class S>
void check_bounds(const MidedgeMap& map, const MidedgePlan& plan, const SubdivideOptions& options, bool textured, const Common& common) {
  if (map.level() > 0 && is_known_ahead(map, plan)) return;
  const unsigned levels = is_known_ahead(map, plan) ? options.levels : std::min(options.levels, map.level() + 1);
  const MidedgeCounts n = midedge_counts_after(map, levels - map.level(), plan.boundary);
  if (2 * n.edges >= 4294967295.0) {
    throw ResourceLimit(fmt::format("level {} would have {:.0f} half-edges; at most 4294967294 are possible", levels, 2 * n.edges));
  }
  if (common.max_facets > 0 && n.facets > static_cast<double>(common.max_facets)) {
    throw ResourceLimit(fmt::format("level {} would have {:.0f} facets, --max-facets allows {}", levels, n.facets, common.max_facets));
  }
  const LimitNeeds needs = levels == options.levels ? limit_needs(map, n, plan, options) : LimitNeeds{};
  if (common.max_facets > 0 && needs.facets > static_cast<double>(common.max_facets)) {
    throw ResourceLimit(fmt::format("limits of level {} may need further steps to {:.0f} facets, --max-facets allows {}", levels,
                                    needs.facets, common.max_facets));
  }
  // Map and points of the last level and the one before it, loops, addresses and text of the output.
  constexpr bool kDouble = std::is_same_v<S, double>;
  const double per_facet = (kDouble ? 320 : 1000) + (textured ? (kDouble ? 200 : 600) : 0);
  const double bytes = n.facets * per_facet + needs.bytes;
  if (common.max_memory > 0 && bytes > static_cast<double>(common.max_memory)) {
    throw ResourceLimit(fmt::format("level {}{} would need about {:.0f} bytes, --max-memory allows {}", levels,
                                    needs.bytes > 0 ? " with its limits" : "", bytes, common.max_memory));
  }
}

template <class S>
std::vector<Point3<double>> in_doubles(const PointArray<S>& points) {
  std::vector<Point3<double>> result(points.size());
  for (std::size_t v = 0; v < points.size(); ++v) result[v] = {to_double(points[v].x), to_double(points[v].y), to_double(points[v].z)};
  return result;
}

template <class S>
nlohmann::ordered_json level_row(const MidedgeMap& map, const PointArray<S>& exact, double seconds) {
  const std::vector<Point3<double>> points = in_doubles<S>(exact);
  const HoneycombStatistics s = measure(map, points, newell_normals(map, points));
  nlohmann::ordered_json row = level_row(counts_of(map), seconds, s);
  row["area"] = fanned_area(map, points);
  row["volume"] = nullptr;
  if (map.closed()) row["volume"] = fanned_volume(map, points, points.front());
  if (!map.closed()) row["pinched_vertices"] = map.pinched_vertex_count();
  return row;
}

/// Double arithmetic may leave its range; nothing about such a level would be true.
template <class S>
void require_finite(const PointArray<S>& points, const MeshAttributes<S>& attributes) {
  if constexpr (std::is_same_v<S, double>) {
    const auto finite = [](const Point3<double>& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z); };
    if (!std::all_of(points.begin(), points.end(), finite)) throw ResourceLimit("a coordinate is beyond the finite doubles");
    const auto& texture = attributes.texture.values;
    if (!std::all_of(texture.begin(), texture.end(), finite)) throw ResourceLimit("a texture coordinate is beyond the finite doubles");
  }
}

/// A level with what it carries.
template <class S>
struct CarryingLevel {
  MidedgeLevel<S> mesh;
  MeshAttributes<S> attributes;
  std::optional<SizeKeeper<S>> keeper{};
  PointArray<S> scaled{};  ///< where there is a keeper

  /// The points as they are reported and written.
  [[nodiscard]] const PointArray<S>& points() const { return keeper ? scaled : mesh.points; }
  void advance(const MidedgePlan& plan) {
    MidedgeLevel<S> next = plan.doubled ? midedge_double_step(mesh, plan.rule) : midedge_step(mesh, plan.rule, plan.boundary);
    if (!attributes.empty()) attributes = refined_attributes(mesh.map, next.map, attributes, plan.rule);
    if (keeper) {
      keeper->step(mesh.map, next.map);
      keeper->fit(next);
      scaled = keeper->scaled(next);
    }
    mesh = std::move(next);
    require_finite<S>(points(), attributes);
  }
};

/// The addresses of the map's facets, with levels counted on from those of the input.
std::vector<FacetAddress> addresses_of(const MidedgeMap& map, const std::vector<FacetAddress>& base) {
  std::vector<FacetAddress> result;
  result.reserve(map.facet_count());
  std::uint32_t before = 0;  // levels that the input already counts
  for (const FacetAddress& address : base) before = std::max(before, address.level);
  for (std::uint32_t f = 0; f < map.facet_count(); ++f) {
    FacetAddress address = map.address(f);
    if (address.parent) {
      address.level += before;
    } else if (f < base.size()) {
      address = base[f];
    }
    result.push_back(address);
  }
  return result;
}

template <class S>
PolygonSoup<S> soup_of(const CarryingLevel<S>& level, std::vector<Point3<S>> points, const std::vector<FacetAddress>& base) {
  const MidedgeMap& map = level.mesh.map;
  PolygonSoup<S> soup;
  soup.points = std::move(points);
  soup.facets = map.loops();
  soup.attributes = level.attributes;
  soup.addresses = addresses_of(map, base);
  return soup;
}

template <class S>
WrittenGeometry write_level(const CarryingLevel<S>& level, const std::vector<FacetAddress>& base, const std::string& path,
                            io::Format format, const SubdivideOptions& options, const Common& common) {
  const OutputChoice output{path, format, {options.color, common.unit}};
  return write_geometry(output, soup_of<S>(level, {level.points().begin(), level.points().end()}, base));
}

Point3<Rational> exact_point(const Point3<Rational>& p) { return p; }
Point3<Rational> exact_point(const Point3<double>& p) {
  return {Rational::from_double(p.x), Rational::from_double(p.y), Rational::from_double(p.z)};
}

/// The level as it is shown, every number taken for what it is.
template <class S>
MidedgeLevel<Rational> exact_level(const CarryingLevel<S>& level) {
  MidedgeLevel<Rational> exact{level.mesh.map, {}};
  for (const Point3<S>& p : level.points()) exact.points.push_back(exact_point(p));
  return exact;
}

/// Writes the level with its vertices moved to their limits, exactly and then rounded once.
template <class S>
WrittenGeometry write_limit_surface(const CarryingLevel<S>& level, const MidedgeLimitPlan& plan, const std::vector<FacetAddress>& base,
                                    const SubdivideOptions& options, const Common& common) {
  const OutputChoice output{options.output, output_format(options.output, options.to), {options.color, common.unit}};
  const std::vector<Point3<Rational>> limits = midedge_vertex_limits(exact_level(level), plan, common.work.part(0.92, 0.99));
  std::vector<Point3<S>> points;
  const S* field = nullptr;
  for (const auto& p : limits) points.push_back({in_field(p.x, field), in_field(p.y, field), in_field(p.z, field)});
  return write_geometry(output, soup_of<S>(level, std::move(points), base));
}

template <class S, class Soup>
CarryingLevel<S> level_of(const Soup& input, MidedgeMap map, const SubdivideOptions& options) {
  const S* field = nullptr;
  const auto convert = [&](const auto& p) { return Point3<S>{in_field(p.x, field), in_field(p.y, field), in_field(p.z, field)}; };
  CarryingLevel<S> level{{std::move(map), {}}, {}};
  for (const auto& p : input.points) level.mesh.points.push_back(convert(p));
  const auto& given = input.attributes;
  CornerValues<S> texture{{}, given.texture.of_corner};
  for (const auto& p : given.texture.values) texture.values.push_back(convert(p));
  level.attributes = {welded(texture), given.texture_size, given.groups, given.materials, given.material_libraries};
  if (options.keep_size) {
    level.keeper.emplace(level.mesh);
    level.scaled = level.mesh.points;
  }
  return level;
}

/// A figure of a level; "-" where there is none, or none that a double could hold.
std::string figure(const nlohmann::ordered_json& x, int digits) {
  return x.is_number() && std::isfinite(x.get<double>()) ? fmt::format("{:.{}g}", x.get<double>(), digits) : "-";
}

std::string report_text(const nlohmann::ordered_json& report) {
  std::string text = "level   vertices     facets  max angle     median      longest     shortest         area       volume  seconds\n";
  for (const auto& row : report["levels"]) {
    text += fmt::format("{:>5} {:>10} {:>10} {:>10.4f} {:>10.4f} {:>12} {:>12} {:>12} {:>12} {:>8.3f}\n", row["level"].get<unsigned>(),
                        row["vertices"].get<std::size_t>(), row["faces"].get<std::size_t>(),
                        row["max_normal_angle_deg"].get<double>(), row["median_normal_angle_deg"].get<double>(),
                        figure(row["longest_edge"], 5), figure(row["shortest_edge"], 5), figure(row["area"], 6), figure(row["volume"], 6),
                        row["seconds"].get<double>());
    const std::size_t pinched = row.value("pinched_vertices", std::size_t{0});
    if (pinched > 0) text += fmt::format("      {} vertices are pinched: the surface touches itself there\n", pinched);
  }
  if (report.contains("size_factors")) {
    for (std::size_t c = 0; c < report["size_factors"].size(); ++c) {
      text += fmt::format("component {} keeps its {}: scaled by {:.6g}\n", c, report["size_measures"][c].get<std::string>(),
                          report["size_factors"][c].get<double>());
    }
  }
  if (report.contains("limit")) text += "the vertices written are in their limits; the figures are those of the levels before they moved\n";
  return text + fmt::format("written to {}\n", report["output"].get<std::string>());
}

template <class S>
Outcome report_of(const CarryingLevel<S>& level, const nlohmann::ordered_json& rows, const SubdivideOptions& options) {
  Outcome outcome;
  auto& report = outcome.report;
  report["scheme"] = options.scheme;
  report["arithmetic"] = options.arithmetic;
  report["boundary"] = level.mesh.map.closed() ? nlohmann::ordered_json() : nlohmann::ordered_json(options.boundary);
  report["levels"] = rows;
  report["output"] = options.output;
  if (options.limit) report["limit"] = true;
  report["certificate"] = nullptr;
  if (level.keeper) {
    report["size_factors"] = level.keeper->factors();
    auto& measures = report["size_measures"] = nlohmann::ordered_json::array();
    for (const SizeMeasure m : level.keeper->measures()) measures.push_back(m == SizeMeasure::volume ? "volume" : "area");
  }
  return outcome;
}

template <class S, class Soup>
Outcome refine(const Soup& input, const SubdivideOptions& options, const Common& common) {
  MidedgeMap map(input.facets, input.points.size());
  const MidedgePlan plan = plan_of(options, map);
  check_bounds<S>(map, plan, options, !input.attributes.texture.empty(), common);
  CarryingLevel<S> level = level_of<S>(input, std::move(map), options);

  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  const auto show = [&](double seconds) {
    rows.push_back(level_row<S>(level.mesh.map, level.points(), seconds));
    if (options.all_levels.empty()) return;
    const std::string path = level_path(options.all_levels, level.mesh.map.level());
    (void)write_level(level, input.addresses, path, level_format(path, options.to), options, common);
  };
  show(0);
  while (level.mesh.map.level() < options.levels) {
    // Each level costs about twice the one before.
    common.work.report(0.05 + 0.8 * std::pow(2.0, static_cast<double>(level.mesh.map.level()) - options.levels));
    if (level.mesh.map.level() > 0) check_bounds<S>(level.mesh.map, plan, options, !level.attributes.texture.empty(), common);
    const auto begin = Clock::now();
    level.advance(plan);
    show(std::chrono::duration<double>(Clock::now() - begin).count());
  }
  if (level.mesh.map.pinched_vertex_count() > 0) {
    common.remark(fmt::format("subdivide: --boundary drop made {} pinched vertices: the result is no manifold",
                              level.mesh.map.pinched_vertex_count()));
  }
  Outcome outcome = report_of(level, rows, options);
  const MidedgeLimitPlan limits{plan.rule, plan.boundary, common.max_facets > 0 ? common.max_facets : kMostLimitFacets};
  common.work.report(0.85);
  if (!options.limit_points.empty()) write_midedge_limits(options, exact_level(level), addresses_of(level.mesh.map, input.addresses), limits, common.work.part(0.85, 0.92));
  if (options.limit && plan.boundary == MidedgeBoundary::close && !level.mesh.map.closed()) {
    common.remark("subdivide: under --boundary close each boundary loop contracts to one point, the mean of its vertices, and "
                  "--limit puts all of them there");
  }
  const WrittenGeometry written =
      options.limit ? write_limit_surface(level, limits, input.addresses, options, common)
                    : write_level(level, input.addresses, options.output, output_format(options.output, options.to), options, common);
  outcome.report["max_rounding"] = written.max_rounding;
  if (options.output != "-") outcome.text = report_text(outcome.report);
  return outcome;
}

}  // namespace

Outcome subdivide_midedge(const SubdivideOptions& options, const Common& common) {
  const io::Format format = output_format(options.output, options.to);
  if (format == io::Format::planes && options.arithmetic == "double") {
    throw UsageError("doubles have no exact planes; write a mesh, or use --arithmetic rational");
  }
  if (!options.all_levels.empty()) (void)level_format(level_path(options.all_levels, 0), options.to);
  const ExactSoup input = exact_soup(io::read_geometry(options.input, named_format(options.from)));
  return std::visit(
      [&](const auto& soup) {
        return options.arithmetic == "rational" ? refine<Rational>(soup, options, common) : refine<double>(soup, options, common);
      },
      input);
}

}  // namespace hexact::app
