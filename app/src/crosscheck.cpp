// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.hpp"
#include "hexact/exact/body_from_soup.hpp"
#include "hexact/io/mesh_file.hpp"
#include "hexact/io/output_file.hpp"
#include "hexact/kernel/errors.hpp"
#include "hexact/validation/openscad_crosscheck.hpp"

#include <fmt/format.h>

#include <memory>
#include <string>
#include <variant>
#include <vector>

namespace hexact::app {
namespace {

using validation::Agreement;
using validation::CrosscheckReport;
using validation::ElementCounts;
using validation::Route;
using validation::RouteReport;

struct CrosscheckArguments {
  std::string mesh;
  std::string from;
  std::string route = "intersection";
  std::string keep;
  validation::CrosscheckOptions options;
};

std::vector<Route> routes_of(const std::string& name) {
  if (name == "all") return {Route::intersection, Route::hull, Route::difference};
  return {name == "hull" ? Route::hull : name == "difference" ? Route::difference : Route::intersection};
}

PlaneBody read_body(const CrosscheckArguments& arguments) {
  std::optional<io::Format> format;
  if (!arguments.from.empty()) {
    format = io::format_from_name(arguments.from);
    if (!format) throw UsageError("--from: there is no format called " + arguments.from);
  }
  io::Geometry geometry = io::read_geometry(arguments.mesh, format);
  if (auto* body = std::get_if<PlaneBody>(&geometry)) return std::move(*body);
  if (auto* certificate = std::get_if<Certificate>(&geometry)) return std::move(certificate->body);
  return body_from_soup(std::get<PolygonSoup<Rational>>(geometry));
}

/// FILE.scad for the first route, FILE.hull.scad and so on for further ones.
std::string name_for(const std::string& file, Route route, bool first) {
  if (first || file == "-") return file;
  const std::string ending = ".scad";
  const bool ends = file.size() > ending.size() && file.compare(file.size() - ending.size(), ending.size(), ending) == 0;
  return (ends ? file.substr(0, file.size() - ending.size()) : file) + "." + validation::name_of(route) + ending;
}

void keep_programs(const PlaneBody& body, const CrosscheckArguments& arguments) {
  const validation::ScadModel model = validation::scad_model(body);
  for (std::size_t i = 0; i < arguments.options.routes.size(); ++i) {
    const Route route = arguments.options.routes[i];
    if (route != Route::hull && !model.representable()) {
      throw ResourceLimit(fmt::format("--keep: a corner of a half-space needs {} bits; OpenSCAD can hold 52", model.corner_bits));
    }
    io::write_file(name_for(arguments.keep, route, i == 0), validation::scad_program(model, route));
  }
}

nlohmann::ordered_json counts_json(const ElementCounts& counts) {
  return {{"vertices", counts.vertices}, {"edges", counts.edges}, {"facets", counts.facets}};
}

template <class T>
nlohmann::ordered_json or_null(const std::optional<T>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

/// The route that decided; the first one when all agree.
const RouteReport* decisive(const CrosscheckReport& report) {
  for (const RouteReport& r : report.routes) {
    if (r.verdict == report.verdict) return &r;
  }
  return report.routes.empty() ? nullptr : &report.routes.front();
}

nlohmann::ordered_json to_json(const CrosscheckReport& report) {
  const RouteReport* route = decisive(report);
  nlohmann::ordered_json json;
  json["verdict"] = validation::name_of(report.verdict);
  json["ours"] = counts_json(report.ours);
  json["openscad"] = route != nullptr && route->openscad ? counts_json(*route->openscad) : nlohmann::ordered_json();
  json["volume_difference"] = route != nullptr ? or_null(route->volume_difference) : nlohmann::ordered_json();
  json["bound"] = route != nullptr ? or_null(route->bound) : nlohmann::ordered_json();
  json["reason"] = report.reason;
  json["routes"] = nlohmann::ordered_json::array();
  for (const RouteReport& r : report.routes) {
    json["routes"].push_back({{"route", validation::name_of(r.route)},
                              {"verdict", validation::name_of(r.verdict)},
                              {"reason", r.reason},
                              {"openscad", r.openscad ? counts_json(*r.openscad) : nlohmann::ordered_json()},
                              {"volume_difference", or_null(r.volume_difference)},
                              {"bound", or_null(r.bound)},
                              {"seconds", r.seconds}});
  }
  return json;
}

std::string to_text(const CrosscheckReport& report) {
  std::string text = fmt::format("{}: ours {} vertices, {} edges, {} facets\n", validation::name_of(report.verdict),
                                 report.ours.vertices, report.ours.edges, report.ours.facets);
  for (const RouteReport& r : report.routes) {
    text += fmt::format("  {:<12} {} ({:.1f} s)", validation::name_of(r.route), validation::name_of(r.verdict), r.seconds);
    if (r.openscad) {
      text += fmt::format(": {} vertices, {} edges, {} facets", r.openscad->vertices, r.openscad->edges, r.openscad->facets);
    }
    if (r.volume_difference && r.bound) {
      text += fmt::format(", volume differs by {:.3g}, rounding explains {:.3g}", *r.volume_difference, *r.bound);
    }
    text += "\n";
  }
  if (!report.reason.empty()) text += "  " + report.reason + "\n";
  return text;
}

Outcome run(const CrosscheckArguments& arguments, const Common& common) {
  const std::uint64_t max_facets = common.max_facets;
  const PlaneBody body = read_body(arguments);
  common.work.report(0.01);
  if (max_facets != 0 && body.plane_count() > max_facets) {
    throw ResourceLimit(fmt::format("the body has {} facets, more than --max-facets {}", body.plane_count(), max_facets));
  }
  if (!arguments.keep.empty()) {
    if (body.field != Field::rational) throw UsageError("--keep: there is no OpenSCAD program of a body over Q(sqrt5)");
    keep_programs(body, arguments);
  }
  const CrosscheckReport report = validation::crosscheck_openscad(body, arguments.options, common.work);
  Outcome outcome;
  outcome.exit_code = report.verdict == Agreement::agree ? kDone : report.verdict == Agreement::differ ? kClaimFails : kUndecided;
  outcome.report = to_json(report);
  outcome.text = to_text(report);
  return outcome;
}

}  // namespace

void add_crosscheck(const Registry& registry) {
  CLI::App* command = registry.add(
      "crosscheck", "Rebuilds the solid in OpenSCAD by its own exact Boolean operations and compares. "
                    "Exit 0: agree, 1: differ, 5: not checked");
  const auto arguments = std::make_shared<CrosscheckArguments>();
  command->add_option("MESH", arguments->mesh, ".planes, a certificate, or an exactly planar mesh")->required();
  command->add_option("--from", arguments->from, "Format of MESH where its name does not tell");
  command->add_option("--time-limit", arguments->options.time_limit, "Seconds for each run of OpenSCAD")
      ->check(CLI::PositiveNumber)->capture_default_str();
  command->add_option("--max-cuts", arguments->options.max_cuts, "Half-spaces; a body with more is not run")
      ->check(CLI::PositiveNumber)->capture_default_str();
  command->add_option("--route", arguments->route, "Boolean operations to build the solid with")
      ->check(CLI::IsMember({"intersection", "hull", "difference", "all"}))->capture_default_str();
  command->add_option("--openscad", arguments->options.openscad, "The program to run")->capture_default_str();
  command->add_option("--keep", arguments->keep, "Also write the OpenSCAD program to this file");
  command->callback([arguments, &registry] {
    arguments->options.routes = routes_of(arguments->route);
    const Common& common = registry.common;
    registry.selected = [arguments, &common] {
      if (arguments->keep == "-" && common.json) throw UsageError("--json and --keep - both want standard output");
      return run(*arguments, common);
    };
  });
}

}  // namespace hexact::app
