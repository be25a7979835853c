// SPDX-License-Identifier: GPL-3.0-or-later
#include "body_input.hpp"
#include "command.hpp"
#include "geometry_output.hpp"

#include <fmt/format.h>

#include <memory>
#include <variant>

namespace hexact::app {
namespace {

struct ConvertOptions {
  std::string input, output, from, to, color;
};

struct Counts {
  std::size_t vertices = 0, facets = 0;
};

Counts counts_of(const PolygonSoup<Rational>& soup) { return {soup.points.size(), soup.facets.size()}; }
Counts counts_of(const PlaneBody& body) {
  Counts counts{body.vertex_count(), 0};
  for (std::size_t f = 0; f < body.loops.size(); ++f) counts.facets += body.loops[f].empty() ? 0 : 1;
  return counts;
}

template <class Shape>
Outcome write_result(const OutputChoice& output, const Shape& shape, const Common& common) {
  common.work.report(0.4);
  const WrittenGeometry written = write_geometry(output, shape, common.work.part(0.4, 1));
  const Counts counts = counts_of(shape);
  Outcome outcome;
  outcome.report["vertices"] = counts.vertices;
  outcome.report["faces"] = counts.facets;
  outcome.report["output"] = output.path;
  outcome.report["exact"] = written.exact;
  outcome.report["max_rounding"] = written.max_rounding;
  if (output.path != "-") {
    outcome.text = fmt::format("{}: {} vertices, {} facets, {}\n", output.path, counts.vertices, counts.facets,
                               written.exact ? std::string("exact")
                                             : fmt::format("vertices rounded by at most {:.3g}", written.max_rounding));
  }
  return outcome;
}

Outcome convert(const ConvertOptions& options, const Common& common) {
  OutputChoice output = choose_output(options.output, options.to, common);
  output.mesh.color = options.color;
  const auto from = named_format(options.from);
  const io::Geometry geometry = io::read_geometry(options.input, from);
  if (const auto* soup = std::get_if<PolygonSoup<Rational>>(&geometry)) return write_result(output, *soup, common);
  if (const auto* body = std::get_if<PlaneBody>(&geometry)) return write_result(output, *body, common);
  return write_result(output, std::get<Certificate>(geometry).body, common);
}

}  // namespace

void add_convert(const Registry& registry) {
  auto options = std::make_shared<ConvertOptions>();
  CLI::App* command = registry.add("convert", "Converts between OBJ, OFF, PLY, STL, .planes and OpenSCAD polyhedra");
  command->add_option("INPUT", options->input, "Mesh, .planes or certificate; - is standard input")->required();
  command->add_option("-o,--output", options->output, "File to write; - is standard output")->required();
  command->add_option("--from", options->from, "Format of the input: obj, off, ply, stl, planes, cert");
  command->add_option("--to", options->to,
                      "Format of the output: obj, off, ply, ply-ascii, ply-float, stl, stl-ascii, planes, scad");
  command->add_option("--color", options->color, "Colour facets by level, angle or reflection lines (PLY, OFF)")
      ->check(CLI::IsMember({"level", "angle", "reflection"}));
  command->callback([options, registry] {
    registry.selected = [options, &common = registry.common] { return convert(*options, common); };
  });
}

}  // namespace hexact::app
