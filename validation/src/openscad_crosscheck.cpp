// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/validation/openscad_crosscheck.hpp"

#include "hexact/kernel/errors.hpp"
#include "hexact/validation/child_process.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <utility>

namespace hexact::validation {
namespace {

std::string seconds_text(double s) {
  const auto number = [](double x) { return std::to_string(static_cast<long>(std::ceil(x))); };
  return s < 120 ? number(s) + " s" : s < 7200 ? number(s / 60) + " minutes" : number(s / 3600) + " hours";
}

/// The last lines that the program printed, for messages.
std::string tail(const std::string& output) {
  constexpr std::size_t kLongest = 200;
  std::string text = output.size() > kLongest ? output.substr(output.size() - kLongest) : output;
  std::replace_if(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 32; }, ' ');
  const auto last = text.find_last_not_of(' ');
  text.resize(last == std::string::npos ? 0 : last + 1);
  return text.empty() ? text : ": " + text;
}

/// Why the child's end is no result; empty when it finished well.
std::string failure_of(const ChildResult& child, const CrosscheckOptions& options) {
  switch (child.end) {
    case ChildResult::End::not_started:
      return "cannot run " + options.openscad + ": " + std::strerror(child.status) + "; is OpenSCAD installed?";
    case ChildResult::End::timed_out:
      return options.openscad + " was stopped after the time limit of " + seconds_text(options.time_limit);
    case ChildResult::End::signalled:
      return options.openscad + " ended by signal " + std::to_string(child.status) + tail(child.output);
    case ChildResult::End::exited:
      break;
  }
  if (child.status == 0) return {};
  return options.openscad + " failed with exit status " + std::to_string(child.status) + tail(child.output);
}

std::optional<std::string> bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(in), {});
}

/// Reads what the run left behind and compares it.
RouteReport judge(const ScadModel& model, const ElementCounts& ours, const ChildResult& child,
                  const std::filesystem::path& mesh_file, RouteReport report) {
  if (report.route != Route::hull) {
    const auto statistics = parse_statistics(child.output);
    if (!statistics) {
      report.reason = "OpenSCAD printed no counts of vertices, edges and facets" + tail(child.output);
      return report;
    }
    report.openscad = ElementCounts{statistics->vertices, statistics->edges, statistics->facets};
    if (!statistics->simple) {
      report.verdict = Agreement::differ;
      report.reason = "OpenSCAD's solid is not a simple polyhedron";
      return report;
    }
  }
  const auto bytes = bytes_of(mesh_file);
  if (!bytes) {
    report.reason = "OpenSCAD wrote no mesh" + tail(child.output);
    return report;
  }
  try {
    const OpenscadMesh mesh = parse_openscad_off(*bytes);
    return compare_export(model, mesh, ours, std::move(report));
  } catch (const ParseError& e) {
    report.reason = "OpenSCAD's mesh cannot be read, line " + std::to_string(e.line().value_or(0)) + ": " + e.what();
  }
  return report;
}

RouteReport run_route(const ScadModel& model, const ElementCounts& ours, Route route, const CrosscheckOptions& options,
                      const ProgressPart& progress) {
  RouteReport report;
  report.route = route;
  if (route != Route::hull && !model.representable()) {
    report.reason = "a corner of a half-space needs " + std::to_string(model.corner_bits) +
                    " bits; OpenSCAD cannot hold more than 52 without changing it";
    return report;
  }
  const TemporaryFolder folder;
  const auto program = folder.path() / "solid.scad", mesh = folder.path() / "solid.off";
  std::ofstream(program, std::ios::binary) << scad_program(model, route);
  const ChildResult child = run_child({options.openscad, "-o", mesh.string(), program.string()}, folder.path(), options.time_limit,
                                      progress);
  report.seconds = child.seconds;
  report.reason = failure_of(child, options);
  if (!report.reason.empty()) return report;
  return judge(model, ours, child, mesh, std::move(report));
}

/// One difference decides; otherwise one missing answer leaves the whole unchecked.
void summarise(CrosscheckReport& report) {
  report.verdict = Agreement::agree;
  for (const RouteReport& r : report.routes) {
    const bool worse = r.verdict == Agreement::differ ? report.verdict != Agreement::differ
                                                      : r.verdict == Agreement::not_checked && report.verdict == Agreement::agree;
    if (!worse) continue;
    report.verdict = r.verdict;
    report.reason = std::string(name_of(r.route)) + ": " + r.reason;
  }
}

}  // namespace

const char* name_of(Agreement agreement) noexcept {
  return agreement == Agreement::agree ? "agree" : agreement == Agreement::differ ? "differ" : "not-checked";
}

double openscad_cost_seconds(std::size_t half_spaces) {
  return 13.0 * std::pow(static_cast<double>(half_spaces) / 326.0, 1.93);
}

ElementCounts element_counts(const PlaneBody& body) {
  ElementCounts counts{body.vertex_count(), body.loops.corner_count() / 2, 0};
  for (std::size_t f = 0; f < body.loops.size(); ++f) counts.facets += body.loops[f].empty() ? 0 : 1;
  return counts;
}

CrosscheckReport crosscheck_openscad(const PlaneBody& body, const CrosscheckOptions& options, const ProgressPart& progress) {
  HEXACT_EXPECTS(!options.routes.empty());
  CrosscheckReport report;
  report.ours = element_counts(body);
  if (body.field != Field::rational) {
    report.reason = "OpenSCAD works over the rational numbers; this body needs sqrt5";
    return report;
  }
  if (body.plane_count() > options.max_cuts) {
    report.reason = "the body has " + std::to_string(body.plane_count()) + " half-spaces, more than the bound of " +
                    std::to_string(options.max_cuts) + "; OpenSCAD would take about " +
                    seconds_text(openscad_cost_seconds(body.plane_count())) + " (--max-cuts and --time-limit allow more)";
    return report;
  }
  const ScadModel model = scad_model(body);
  for (const Route route : options.routes) {
    progress.report(static_cast<double>(report.routes.size()) / static_cast<double>(options.routes.size()));
    report.routes.push_back(run_route(model, report.ours, route, options, progress));
  }
  summarise(report);
  return report;
}

}  // namespace hexact::validation
