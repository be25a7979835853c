// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/prepare.hpp"

#include "body_input.hpp"
#include "command.hpp"
#include "exact_output.hpp"
#include "hexact/kernel/mesh_topology.hpp"

#include <fmt/format.h>

#include <memory>

namespace hexact::app {
namespace {

struct PrepareCommand {
  std::string input, output, from, to, truncate, corner_cut;
  bool planes = false, hull = false, dual = false, triangulate = false;
  unsigned snap_bits = 0;
};

std::optional<Rational> share(const std::string& text, const char* option) {
  if (text.empty()) return std::nullopt;
  Rational value;
  if (Rational::parse(text, value) != Rational::ParseResult::ok) {
    throw UsageError(fmt::format("{} takes a decimal or p/q, not {}", option, text));
  }
  if (value.sign() <= 0 || value >= Rational(Integer(1), Integer(2))) {
    throw UsageError(fmt::format("{} must lie between 0 and 1/2, not {}", option, text));
  }
  return value;
}

PrepareOptions options_of(const PrepareCommand& command) {
  PrepareOptions options;
  options.fit_planes = command.planes;
  options.hull = command.hull;
  options.truncate = share(command.truncate, "--truncate");
  options.dual = command.dual;
  options.corner_cut = share(command.corner_cut, "--corner-cut");
  options.triangulate = command.triangulate;
  if (command.snap_bits != 0) options.snap_bits = command.snap_bits;
  return options;
}

MeshTopology topology_of(const ExactSoup& soup) {
  return std::visit([](const auto& s) { return analyse_topology(s.facets, s.points.size()); }, soup);
}

/// Facets that the steps can make at most.
std::size_t largest_facet_count(const ExactSoup& soup, const PrepareOptions& options) {
  const MeshTopology t = topology_of(soup);
  std::size_t facets = t.facets, vertices = t.vertices, edges = t.edges;
  if (options.hull) facets = 2 * vertices;
  if (options.dual) std::swap(facets, vertices);
  if (options.corner_cut) {
    facets += vertices;
    edges *= 3;
  }
  if (options.triangulate) facets = 2 * edges;
  return facets;
}

void check_bounds(const ExactSoup& soup, const PrepareOptions& options, const Common& common) {
  if (common.max_facets == 0) return;
  const std::size_t facets = largest_facet_count(soup, options);
  if (facets > common.max_facets) {
    throw ResourceLimit(fmt::format("up to {} facets would pass --max-facets {}", facets, common.max_facets));
  }
}

Outcome run(const PrepareCommand& command, const Common& common) {
  const OutputChoice output = choose_output(command.output, command.to, common);
  const PrepareOptions options = options_of(command);
  const ExactSoup soup = exact_soup(io::read_geometry(command.input, named_format(command.from)));
  check_bounds(soup, options, common);
  const PreparedMesh prepared = prepare(soup, options, common.work.part(0.2, 0.8));
  const WrittenGeometry written = write_exact(output, prepared.soup, prepared.body, common.work.part(0.8, 1));
  remark_rounding("prepare", written, common);
  const MeshTopology topology = topology_of(prepared.soup);
  Outcome outcome;
  auto& report = outcome.report;
  report["max_displacement"] = prepared.max_displacement;
  report["merged_facets"] = prepared.merged_facets;
  report["dropped_vertices"] = prepared.dropped_vertices;
  report["truncated_vertices"] = prepared.truncated_vertices;
  report["vertices"] = topology.vertices;
  report["edges"] = topology.edges;
  report["faces"] = topology.facets;
  report["output"] = output.path;
  report["exact"] = written.exact;
  report["max_rounding"] = written.max_rounding;
  if (output.path != "-") {
    const std::string unit = common.unit.empty() ? "" : " " + common.unit;
    outcome.text = fmt::format(
        "{}: {} vertices, {} edges, {} facets\n"
        "merged facets {}, dropped vertices {}, truncated vertices {}, largest displacement at most {:.6g}{}\n",
        output.path, topology.vertices, topology.edges, topology.facets, prepared.merged_facets,
        prepared.dropped_vertices, prepared.truncated_vertices, prepared.max_displacement, unit);
  }
  return outcome;
}

}  // namespace

void add_prepare(const Registry& registry) {
  auto command = std::make_shared<PrepareCommand>();
  CLI::App* app = registry.add("prepare", "Makes meshes fit for exact work; without options merges coplanar facets and "
                                          "drops valence-2 vertices. Options are applied in the order listed");
  app->add_option("MESH", command->input, "Mesh, .planes or certificate; - is standard input")->required();
  app->add_option("-o,--output", command->output, "File to write; only .planes keeps an exact result")->required();
  app->add_option("--from", command->from, "Format of the input: obj, off, ply, stl, planes, cert");
  app->add_option("--to", command->to, "Format of the output where its name does not tell");
  app->add_flag("--planes", command->planes, "Exact convex polyhedron from facets that are only nearly planar");
  app->add_flag("--hull", command->hull, "Exact convex hull of the vertices");
  app->add_flag("--truncate{1/3}", command->truncate,
                "Cut vertices where not three facets meet by one plane each; --truncate=θ with 0 < θ < 1/2");
  app->add_flag("--dual", command->dual, "A vertex at the mean of each facet, a facet for each vertex");
  app->add_flag("--corner-cut{1/3}", command->corner_cut,
                "Two points on each edge at t and 1 - t; --corner-cut=t with 0 < t < 1/2");
  app->add_flag("--triangulate", command->triangulate, "Cut facets into triangles");
  app->add_option("--snap", command->snap_bits, "Round planes to BITS bits, keeping the combinatorics")
      ->check(CLI::Range(2u, 4096u))
      ->type_name("BITS");
  app->callback([command, registry] {
    registry.selected = [command, &common = registry.common] { return run(*command, common); };
  });
}

}  // namespace hexact::app
