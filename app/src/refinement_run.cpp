// SPDX-License-Identifier: GPL-3.0-or-later
#include "refinement_run.hpp"

#include "geometry_output.hpp"
#include "hexact/exact/body_from_soup.hpp"
#include "hexact/exact/certify.hpp"
#include "hexact/io/mesh_file.hpp"
#include "level_row.hpp"
#include "limit_points_output.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <memory>

namespace hexact::app {
namespace {

struct Counts {
  double facets, vertices;
};

/// Counts of the last level: a honeycomb step makes V' = 3V and F' = F + V, a chamfer step V' = 4V and F' = F + E.
Counts counts_after(const PlaneBody& body, const RefinementPlan& plan) {
  Counts n{static_cast<double>(body.loops.size()), static_cast<double>(body.vertex_count())};
  for (unsigned l = 0; l < plan.levels(); ++l) {
    const bool chamfer = l >= plan.honeycomb_levels;
    n.facets += chamfer ? 1.5 * n.vertices : n.vertices;
    n.vertices *= chamfer ? 4 : 3;
  }
  return n;
}

nlohmann::ordered_json level_row(const Refinement& refinement, const StepReport& step, const HoneycombStatistics& s) {
  nlohmann::ordered_json row = level_row(counts_of(refinement.map()), step.seconds, s);
  if (step.least_delta) row["delta"] = *step.least_delta;
  if (!step.delta.empty()) row["delta"] = step.delta;
  if (step.plane_bits) row["plane_bits"] = *step.plane_bits;
  return row;
}

std::string text_row(const nlohmann::ordered_json& row) {
  return fmt::format("{:>5} {:>10} {:>10} {:>10.4f} {:>10.4f} {:>12.5g} {:>12.5g} {:>8.3f}\n", row["level"].get<unsigned>(),
                     row["vertices"].get<std::size_t>(), row["faces"].get<std::size_t>(),
                     row["max_normal_angle_deg"].get<double>(), row["median_normal_angle_deg"].get<double>(),
                     row["longest_edge"].get<double>(), row["shortest_edge"].get<double>(), row["seconds"].get<double>());
}

/// Writes a level; returns the proven bound of the rounding (0 for exact formats).
double write_level(const Refinement& refinement, const std::string& path, io::Format format, const SubdivideOptions& options,
                   const Common& common, const ProgressPart& progress) {
  const OutputChoice output{path, format, {options.color, common.unit}};
  if (refinement.is_exact()) return write_geometry(output, refinement.body(), progress).max_rounding;
  const RoundedVertices vertices = refinement.vertices(io::coordinate_format(format));
  const FacetLoops loops = refinement.map().loops();
  io::write_mesh(path, format, {vertices.points, loops, addresses_of(refinement.map())}, output.mesh);
  return vertices.max_rounding;
}

/// The policy of all further levels, where it is one of sizes and known.
std::optional<SizePolicy> lasting_policy(const RefinementPlan& plan, const HoneycombMap& map) {
  if (!plan.schedule_is_lasting || plan.chamfer_levels > 0) return std::nullopt;
  const CutPolicy policy = plan.schedule(map);
  const auto* sizes = std::get_if<SizePolicy>(&policy);
  return sizes != nullptr ? std::optional(*sizes) : std::nullopt;
}

/// The input in the frame of the result, whose first planes are its planes, exactly.
PlaneBody reference_body(const PlaneBody& input, const PlaneBody& result) {
  PlaneBody base;
  base.field = result.field;
  base.scale = result.scale;
  base.shift = result.shift;
  for (std::size_t f = 0; f < input.loops.size(); ++f) {
    if (result.field == Field::rational) {
      base.planes.push_back(result.planes[f]);
    } else {
      base.planes_sqrt5.push_back(result.planes_sqrt5[f]);
    }
    base.addresses.push_back({});
  }
  base.loops = input.loops;
  base.triples = input.triples;
  return base;
}

/// Every claim about a chain of honeycomb and chamfer steps; the signs behind them were decided level by level.
void write_chain_certificate(const BodyInput& input, PlaneBody result, const SubdivideOptions& options,
                             const RefinementPlan& plan, const ProgressPart& progress) {
  const std::string name = "input";
  std::vector<Claim> claims = {{"closed", ""}, {"planar", ""}, {"trivalent", ""}, {"convex", ""},
                               {"inside", name}, {"tangent", name}, {"corner-cut-of", name}};
  std::vector<std::string> provenance = {
      fmt::format("hexact {}", HEXACT_VERSION),
      fmt::format("subdivide --scheme {} --levels {} {}", options.scheme, options.levels, plan.provenance)};
  PlaneBody base = reference_body(input.body, result);
  const Certificate certificate =
      make_certificate(std::move(result), std::move(claims), {{name, std::move(base)}}, std::move(provenance), progress);
  io::write_certificate(options.certificate, certificate);
}

/// Where the stopping rules end the refinement.
struct Stop {
  bool keep_new = true;  ///< whether the level just made is the result
  bool finished = false;
  std::string reason;
};

Stop stopping(const SubdivideOptions& options, const HoneycombStatistics& s, unsigned level) {
  if (options.stop_min_edge > 0 && s.shortest_edge < options.stop_min_edge) {
    return {false, true, fmt::format("level {} would have an edge of {:.6g}, below --stop-min-edge", level, s.shortest_edge)};
  }
  if (options.stop_max_panel > 0 && s.max_facet_diameter <= options.stop_max_panel) {
    return {true, true, fmt::format("level {} is the first with all panels within --stop-max-panel", level)};
  }
  return {};
}

struct Totals {
  double change = 0;
  double least = std::numeric_limits<double>::infinity();
  bool has_change = false;
  std::string stopped;
};

/// Each level costs about three times the one before.
ProgressPart share_of_level(const ProgressPart& progress, unsigned level, unsigned levels) {
  const auto cost_before = [&](unsigned l) { return std::pow(3.0, static_cast<double>(l) - levels); };
  return progress.part(level == 1 ? 0 : cost_before(level - 1), cost_before(level));
}

void refine(std::unique_ptr<Refinement>& current, const SubdivideOptions& options, const RefinementPlan& plan,
            const Common& common, nlohmann::ordered_json& rows, Totals& totals) {
  const bool may_step_back = options.stop_min_edge > 0;
  const ProgressPart progress = common.work.part(0.05, 0.7);
  progress.report(0);
  for (unsigned l = 1; l <= plan.levels(); ++l) {
    std::unique_ptr<Refinement> before = may_step_back ? std::make_unique<Refinement>(*current) : nullptr;
    if (l == plan.honeycomb_levels + 1) current->start_chamfer(plan.lifts.factors);
    const ProgressPart share = share_of_level(progress, l, plan.levels());
    const StepReport step = l <= plan.honeycomb_levels ? current->advance(plan.schedule, share) : current->chamfer(plan.lifts.rule, share);
    share.report(1);
    const HoneycombStatistics s = current->statistics();
    const Stop stop = stopping(options, s, l);
    if (!stop.keep_new) {
      current = std::move(before);
      totals.stopped = stop.reason;
      return;
    }
    rows.push_back(level_row(*current, step, s));
    if (step.parameter_change) {
      totals.has_change = true;
      totals.change = std::max(totals.change, *step.parameter_change);
      totals.least = std::min(totals.least, *step.min_parameter);
    }
    if (!options.all_levels.empty()) {
      const std::string path = level_path(options.all_levels, l);
      write_level(*current, path, level_format(path, options.to), options, common, {});
    }
    if (stop.finished) {
      totals.stopped = stop.reason;
      return;
    }
  }
}

std::string report_text(const nlohmann::ordered_json& report) {
  std::string text = "level   vertices     facets  max angle     median      longest     shortest  seconds\n";
  for (const auto& row : report["levels"]) text += text_row(row);
  if (report.contains("stopped")) text += report["stopped"].get<std::string>() + "\n";
  if (report["max_parameter_change"].is_number()) {
    text += fmt::format("parameters realised within {:.3g} of those asked\n", report["max_parameter_change"].get<double>());
  }
  return text + fmt::format("written to {}\n", report["output"].get<std::string>());
}

}  // namespace

void check_output(const SubdivideOptions& options) {
  (void)output_format(options.output, options.to);
  if (!options.all_levels.empty()) (void)level_format(level_path(options.all_levels, 0), options.to);
}

BodyInput read_convex(const SubdivideOptions& options) {
  BodyInput input = read_body(options.input, options.from);
  if (auto findings = convex_trivalent_findings(input.body); !findings.empty()) throw InvalidInput(std::move(findings));
  return input;
}

void check_bounds(const PlaneBody& body, const RefinementPlan& plan, const Common& common) {
  const unsigned levels = plan.levels();
  const Counts n = counts_after(body, plan);
  const double half_edges = 3 * n.vertices;
  if (half_edges >= 4294967295.0) {
    throw ResourceLimit(fmt::format("level {} would have {:.0f} half-edges; at most 4294967294 are possible", levels, half_edges));
  }
  if (common.max_facets > 0 && n.facets > static_cast<double>(common.max_facets)) {
    throw ResourceLimit(fmt::format("level {} would have {:.0f} facets, --max-facets allows {}", levels, n.facets, common.max_facets));
  }
  // Map, planes, points and loops of the last level, and the level before it.
  constexpr double kBytesPerFacet = 320;
  if (common.max_memory > 0 && n.facets * kBytesPerFacet > static_cast<double>(common.max_memory)) {
    throw ResourceLimit(fmt::format("level {} would need about {:.0f} bytes, --max-memory allows {}", levels,
                                    n.facets * kBytesPerFacet, common.max_memory));
  }
}

Outcome run_refinement(const BodyInput& input, Refinement start, const RefinementPlan& plan, const SubdivideOptions& options,
                       const Common& common) {
  auto current = std::make_unique<Refinement>(std::move(start));
  nlohmann::ordered_json rows = nlohmann::ordered_json::array();
  rows.push_back(level_row(*current, {}, current->statistics()));
  Totals totals;
  refine(current, options, plan, common, rows, totals);

  Outcome outcome;
  auto& report = outcome.report;
  report["scheme"] = options.scheme;
  report["arithmetic"] = options.arithmetic;
  report["levels"] = rows;
  report["output"] = options.output;
  report["certificate"] = options.certificate.empty() ? nlohmann::ordered_json() : nlohmann::ordered_json(options.certificate);
  if (!options.certificate.empty()) write_chain_certificate(input, current->body(), options, plan, common.work.part(0.7, 0.8));
  report["max_rounding"] = write_level(*current, options.output, output_format(options.output, options.to), options, common,
                                       common.work.part(0.8, 0.9));
  report["max_parameter_change"] = totals.has_change ? nlohmann::ordered_json(totals.change) : nlohmann::ordered_json();
  report["min_parameter"] = totals.has_change ? nlohmann::ordered_json(totals.least) : nlohmann::ordered_json();
  if (!totals.stopped.empty()) report["stopped"] = totals.stopped;
  if (!options.limit_points.empty()) {
    write_limit_points(options.limit_points, *current, options, lasting_policy(plan, current->map()), common.work.part(0.9, 1));
  }
  if (options.output != "-") outcome.text = report_text(report);
  return outcome;
}

}  // namespace hexact::app
