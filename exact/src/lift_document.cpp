// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/lift_document.hpp"

#include <algorithm>
#include <map>
#include <string>

namespace hexact {
namespace {

[[noreturn]] void refuse(const std::string& message, const std::string& element) {
  throw InvalidInput("BadLifts", message, element);
}

std::string level_name(std::uint32_t level) { return std::string("level ") + std::to_string(level); }

std::string edge_name(std::uint32_t a, std::uint32_t b) {
  return std::string("edge ") + std::to_string(a) + "-" + std::to_string(b);
}

/// Number of the edge ab; nullopt when the level has none.
std::optional<std::uint32_t> find_edge(const HoneycombMap& map, const EdgeNumbering& edges, std::uint32_t a, std::uint32_t b) {
  if (a >= map.vertex_count()) return std::nullopt;
  for (const std::uint32_t h : map.star(a)) {
    if (map.target(h) == b) return edges.edge[h];
  }
  return std::nullopt;
}

ExactLifts lifts_of(const LiftDocument::Level& said, const HoneycombMap& map, const EdgeNumbering& edges) {
  if (!said.edges) return {said.lifts};  // chamfer_step counts them
  std::vector<std::optional<Rational>> found(map.edge_count());
  for (const LiftDocument::Edge& e : *said.edges) {
    const auto number = find_edge(map, edges, e.a, e.b);
    if (!number) refuse("does not exist at " + level_name(said.level), edge_name(e.a, e.b));
    if (found[*number]) refuse("is given twice for " + level_name(said.level), edge_name(e.a, e.b));
    found[*number] = e.lift;
  }
  ExactLifts lifts;
  for (std::uint32_t e = 0; e < found.size(); ++e) {
    const std::uint32_t h = edges.half_edge[e];
    if (!found[e]) {
      refuse("has no lift: " + std::to_string(said.edges->size()) + " are given for " + level_name(said.level) + ", expected " +
                 std::to_string(found.size()), edge_name(map.origin(h), map.target(h)));
    }
    lifts.values.push_back(*found[e]);
  }
  return lifts;
}

}  // namespace

LiftRule document_lifts(const LiftDocument& document, LiftRule otherwise) {
  std::map<std::uint32_t, LiftDocument::Level> levels;
  for (const auto& level : document.levels) {
    if (!levels.emplace(level.level, level).second) refuse("is given twice", level_name(level.level));
  }
  return [levels = std::move(levels), automatic = document.automatic_otherwise, otherwise = std::move(otherwise)](
             const ChamferLevel& level, const EdgeNumbering& edges) -> Lifts {
    const auto said = levels.find(level.surface.map.level());
    if (said != levels.end()) return lifts_of(said->second, level.surface.map, edges);
    if (!automatic) refuse("has no lifts in the document, which names no \"default\"", level_name(level.surface.map.level()));
    return otherwise(level, edges);
  };
}

}  // namespace hexact
