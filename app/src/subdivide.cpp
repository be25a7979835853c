// SPDX-License-Identifier: GPL-3.0-or-later
#include "subdivide.hpp"

#include "body_input.hpp"
#include "lift_choice.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace hexact::app {
namespace {

struct Scheme {
  Outcome (*refine)(const SubdivideOptions&, const Common&);
  std::vector<std::string> arithmetics;  ///< the first is the default
  std::set<std::string> options;         ///< beyond those of all schemes
};

const std::map<std::string, Scheme>& schemes() {
  static const Scheme midedge = {subdivide_midedge, {"double", "rational"}, {"--boundary", "--keep-size", "--limit", "--limit-points"}};
  static const std::map<std::string, Scheme> table = {
      {"phs", {subdivide_honeycomb, {"snapped", "rational", "qsqrt5", "double"},
               {"--parameters", "--bits", "--certificate", "--limit-points", "--stop-min-edge", "--stop-max-panel", "--then",
                "--lifts", "--keep"}}},
      {"chamfer", {subdivide_chamfer, {"integer"},
                   {"--certificate", "--limit-points", "--stop-min-edge", "--stop-max-panel", "--lifts", "--keep"}}},
      {"midedge", midedge},
      {"midedge6", midedge},
  };
  return table;
}

std::set<std::string> names_of_schemes() {
  std::set<std::string> names;
  for (const auto& [name, scheme] : schemes()) names.insert(name);
  return names;
}

/// Options of other schemes are refused, and the scheme's default arithmetic is filled in.
void settle(const CLI::App& command, SubdivideOptions& options) {
  const Scheme& scheme = schemes().at(options.scheme);
  for (const auto& [other, description] : schemes()) {
    for (const std::string& name : description.options) {
      if (command.count(name) > 0 && scheme.options.count(name) == 0) {
        throw UsageError(fmt::format("--scheme {} has no option {}", options.scheme, name));
      }
    }
  }
  if (options.arithmetic.empty()) options.arithmetic = scheme.arithmetics.front();
  const auto& known = scheme.arithmetics;
  if (std::find(known.begin(), known.end(), options.arithmetic) == known.end()) {
    throw UsageError(fmt::format("--scheme {} has no --arithmetic {}", options.scheme, options.arithmetic));
  }
}

/// The places that the command line names, and what is written there.
std::vector<std::pair<std::string, std::string>> places(const SubdivideOptions& options) {
  std::vector<std::pair<std::string, std::string>> result = {{"-o", options.output}};
  if (!options.limit_points.empty()) result.emplace_back("--limit-points", options.limit_points);
  if (!options.certificate.empty()) result.emplace_back("--certificate", options.certificate);
  return result;
}

bool uses_standard_output(const SubdivideOptions& options) {
  const auto named = places(options);
  return std::any_of(named.begin(), named.end(), [](const auto& place) { return place.second == "-"; });
}

/// Whether --all-levels writes a level to this path.
bool is_level(const std::filesystem::path& path, const SubdivideOptions& options) {
  if (options.all_levels.empty()) return false;
  const unsigned first = options.scheme.starts_with("midedge") ? 0 : 1;
  const unsigned last = options.levels + (options.then.empty() ? 0 : chamfer_levels(options.then));
  for (unsigned l = first; l <= last; ++l) {
    if (std::filesystem::path(level_path(options.all_levels, l)).lexically_normal() == path) return true;
  }
  return false;
}

/// Two results in one place: the second would replace the first, or both would run together on standard output.
void refuse_shared_places(const SubdivideOptions& options, const Common& common) {
  std::map<std::filesystem::path, std::string> users;
  if (common.json) users.emplace("-", "--json");
  for (const auto& [option, place] : places(options)) {
    const auto path = std::filesystem::path(place).lexically_normal();
    const auto [user, is_new] = users.emplace(path, option);
    if (!is_new && place == "-") throw UsageError(fmt::format("{} and {} - both need standard output", user->second, option));
    if (!is_new) throw UsageError(fmt::format("{} and {} both name {}", user->second, option, place));
    if (is_level(path, options)) throw UsageError(fmt::format("--all-levels and {} both name {}", option, place));
  }
}

}  // namespace

io::Format output_format(const std::string& path, const std::string& name) {
  if (const auto format = named_format(name)) return *format;
  if (const auto format = io::format_from_path(path)) return *format;
  throw UsageError("the format of " + path + " is not known from its ending; name it with --to");
}

io::Format level_format(const std::string& path, const std::string& name) {
  const auto by_ending = io::format_from_path(path);
  const std::string family = "." + name.substr(0, name.find('-'));
  return by_ending && !path.ends_with(family) ? *by_ending : output_format(path, name);
}

std::string level_path(const std::string& pattern, unsigned level) {
  const std::size_t at = pattern.find('%');
  const std::size_t end = at == std::string::npos ? at : pattern.find('d', at);
  if (end == std::string::npos) throw UsageError("--all-levels needs a pattern with %d for the level, e.g. level%d.planes");
  const std::string width = pattern.substr(at + 1, end - at - 1);
  if (width.find_first_not_of("0123456789") != std::string::npos || width.size() > 2) {
    throw UsageError("--all-levels: only %d or %0Nd may stand in the pattern");
  }
  const int digits = width.empty() ? 0 : std::stoi(width);
  return pattern.substr(0, at) + fmt::format("{:0{}}", level, digits) + pattern.substr(end + 1);
}

void add_subdivide(const Registry& registry) {
  const auto options = std::make_shared<SubdivideOptions>();
  CLI::App* command = registry.add("subdivide", "Refine a mesh by a subdivision scheme");
  command->add_option("MESH", options->input, "Input; - is standard input")->required();
  command->add_option("-o,--output", options->output, "Output; its ending names the format")->required();
  command->add_option("--from", options->from, "Format of the input");
  command->add_option("--to", options->to, "Format of the output");
  command->add_option("--scheme", options->scheme, "Subdivision scheme")->check(CLI::IsMember(names_of_schemes()));
  command->add_option("--levels", options->levels, "Number of levels; 1 if not given")->check(CLI::Range(0, 1000));
  command->add_option("--parameters", options->parameters,
                      "static, equal-u, constant=B, constant=3:2/5,4:1/4,6:0, random=SEED, tangent=sphere|ellipsoid|FILE, file=JSON");
  command->add_option("--arithmetic", options->arithmetic, "Numbers to compute with; phs: snapped, chamfer: integer, midedge: double if not given")
      ->check(CLI::IsMember({"snapped", "rational", "qsqrt5", "double", "integer"}));
  command->add_option("--bits", options->bits, "Upper bound on the bits of a snapped plane's normal")->check(CLI::Range(22, 1 << 20));
  command->add_option("--certificate", options->certificate, "Write a certificate of the result");
  command->add_option("--limit-points", options->limit_points, "JSON: the limit point of each facet (phs: a point near it), plane and bound");
  command->add_option("--stop-min-edge", options->stop_min_edge, "End before an edge gets shorter than this")->check(CLI::PositiveNumber);
  command->add_option("--stop-max-panel", options->stop_max_panel, "End when all facets are at most this wide")->check(CLI::PositiveNumber);
  command->add_option("--all-levels", options->all_levels, "Write every level; %d stands for the level");
  command->add_option("--color", options->color, "Colour facets by level, angle or reflection lines (PLY, OFF)")->check(CLI::IsMember({"level", "angle", "reflection"}));
  command->add_option("--boundary", options->boundary, "Midedge on open meshes: dual (default), close or drop")
      ->check(CLI::IsMember({"dual", "close", "drop"}));
  command->add_flag("--keep-size", options->keep_size, "Midedge: scale every level so that each component keeps its volume or, if open, its area");
  command->add_flag("--limit", options->limit, "Midedge: write the vertices in their places on the limit surface (not under --boundary drop)");
  command->add_option("--then", options->then, "chamfer:K: K chamfer steps after the honeycomb steps");
  command->add_option("--lifts", options->lifts, "Lifts of chamfer steps: auto (default), file=JSON, fair, or fair=product|harmonic|even|ratio");
  command->add_option("--keep", options->keep, "Fraction of every side that a chamfer step keeps, 0.5 (fair: 0.25) if not given; smooth: 1 - 2^-(k+2)");
  command->callback([registry, options, command] {
    registry.selected = [options, command, &common = registry.common] {
      settle(*command, *options);
      refuse_shared_places(*options, common);
      Outcome outcome = schemes().at(options->scheme).refine(*options, common);
      if (uses_standard_output(*options)) outcome.text.clear();
      return outcome;
    };
  });
}

}  // namespace hexact::app
