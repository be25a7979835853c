// SPDX-License-Identifier: GPL-3.0-or-later
#include "command.hpp"
#include "exact_output.hpp"
#include "hexact/exact/body_from_soup.hpp"
#include "hexact/exact/sample_solids.hpp"
#include "hexact/kernel/errors.hpp"
#include "hexact/kernel/mesh_topology.hpp"

#include <fmt/format.h>

#include <memory>

namespace hexact::app {
namespace {

constexpr std::uint64_t kLargestCount = 100000;
constexpr std::size_t kLargestGrid = 1000000;

struct MakeOptions {
  std::string name, output, to;
  std::vector<std::string> parameters;
};

std::string list_of_samples() {
  std::string text = "Samples:\n  prism N            over an N-gon inscribed in a circle, with rational corners\n"
                     "  random N SEED      a generic solid with N facets, three at each vertex\n"
                     "  grid M N           M x N quadrilaterals that are not planar, with a boundary\n"
                     "  planar-saddle      19 planar hexagons of a saddle, with a boundary\n";
  for (const SampleName& s : sample_names()) text += fmt::format("  {:<24} {}\n", s.name, s.description);
  return text;
}

std::uint64_t number(const std::string& text, const char* what) {
  Integer value;
  if (!Integer::parse(text, value) || value.sign() < 0 || value.bit_length() > 64) {
    throw UsageError(fmt::format("{} must be a number, not {}", what, text));
  }
  return mpz_get_ui(value.raw());
}

std::size_t count(const std::string& text, const char* what, std::uint64_t least, const Common& common) {
  const std::uint64_t n = number(text, what);
  if (n < least) throw UsageError(fmt::format("{} must be at least {}", what, least));
  if (n > kLargestCount) throw ResourceLimit(fmt::format("{} is limited to {}", what, kLargestCount));
  if (common.max_facets != 0 && n > common.max_facets) {
    throw ResourceLimit(fmt::format("{} facets would pass --max-facets {}", n, common.max_facets));
  }
  return n;
}

/// A sample as polygons, and as planes where those say more.
struct Sample {
  ExactSoup soup;
  std::optional<PlaneBody> body;
};

Sample sample(const MakeOptions& options, const Common& common) {
  const std::size_t given = options.parameters.size();
  const auto expect = [&](std::size_t n, const char* usage) {
    if (given != n) throw UsageError(fmt::format("usage: hexact make {} -o OUT", usage));
  };
  if (options.name == "prism") {
    expect(1, "prism N");
    return {prism(count(options.parameters[0], "N", 3, common)), {}};
  }
  if (options.name == "random") {
    expect(2, "random N SEED");
    return {random_solid(count(options.parameters[0], "N", 4, common), number(options.parameters[1], "SEED")), {}};
  }
  if (options.name == "planar-saddle") {
    expect(0, "planar-saddle");
    PlaneBody body = planar_saddle();
    return {rational_soup(body), body};
  }
  if (options.name == "grid") {
    expect(2, "grid M N");
    const std::size_t m = count(options.parameters[0], "M", 1, common), n = count(options.parameters[1], "N", 1, common);
    if (m > kLargestGrid / n) throw ResourceLimit(fmt::format("a grid is limited to {} facets", kLargestGrid));
    if (common.max_facets != 0 && m * n > common.max_facets) {
      throw ResourceLimit(fmt::format("{} facets would pass --max-facets {}", m * n, common.max_facets));
    }
    return {grid(m, n), {}};
  }
  for (const SampleName& s : sample_names()) {
    if (s.name != options.name) continue;
    expect(0, options.name.c_str());
    return {sample_solid(options.name), {}};
  }
  throw UsageError("there is no sample " + options.name + "\n" + list_of_samples());
}

Outcome make(const MakeOptions& options, const Common& common) {
  const OutputChoice output = choose_output(options.output, options.to, common);
  const auto [soup, body] = sample(options, common);
  common.work.report(0.1);
  const WrittenGeometry written = write_exact(output, soup, body, common.work);
  remark_rounding("make", written, common);
  const MeshTopology topology =
      std::visit([](const auto& s) { return analyse_topology(s.facets, s.points.size()); }, soup);
  Outcome outcome;
  outcome.report["vertices"] = topology.vertices;
  outcome.report["edges"] = topology.edges;
  outcome.report["faces"] = topology.facets;
  outcome.report["output"] = output.path;
  outcome.report["exact"] = written.exact;
  outcome.report["max_rounding"] = written.max_rounding;
  if (output.path != "-") {
    outcome.text = fmt::format("{}: {} vertices, {} edges, {} facets\n", output.path, topology.vertices,
                               topology.edges, topology.facets);
  }
  return outcome;
}

}  // namespace

void add_make(const Registry& registry) {
  auto options = std::make_shared<MakeOptions>();
  CLI::App* command = registry.add("make", "Writes an exact sample solid");
  command->add_option("NAME", options->name, "Which sample")->required();
  command->add_option("PARAMETERS", options->parameters, "N for prism, N SEED for random, M N for grid");
  command->add_option("-o,--output", options->output, "File to write; - is standard output")->required();
  command->add_option("--to", options->to, "Format of the output where its name does not tell");
  command->footer(list_of_samples());
  command->callback([options, registry] {
    registry.selected = [options, &common = registry.common] { return make(*options, common); };
  });
}

}  // namespace hexact::app
