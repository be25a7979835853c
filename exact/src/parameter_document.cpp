// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/parameter_document.hpp"

#include <algorithm>
#include <limits>
#include <memory>
#include <unordered_map>

namespace hexact {
namespace {

using HalfEdgeTable = std::unordered_map<std::uint64_t, QuadraticField>;

[[noreturn]] void refuse(const std::string& message, const std::string& element) {
  throw InvalidInput("BadParameters", message, element);
}

std::string level_name(std::uint32_t level) {
  std::string name = "level ";
  name += std::to_string(level);
  return name;
}

std::uint64_t key(std::uint32_t a, std::uint32_t b) { return std::uint64_t{a} << 32 | b; }

bool has_edge(const HoneycombMap& map, std::uint32_t a, std::uint32_t b) {
  if (a >= map.vertex_count()) return false;
  const auto star = map.star(a);
  return std::any_of(star.begin(), star.end(), [&](std::uint32_t h) { return map.target(h) == b; });
}

HalfEdgeTable edge_table(const ParameterDocument::Level& said, const HoneycombMap& map) {
  HalfEdgeTable table;
  for (const auto& e : said.edges) {
    std::string name = "edge ";
    name.append(std::to_string(e.a)).append("-").append(std::to_string(e.b));
    if (!has_edge(map, e.a, e.b)) refuse("does not exist at " + level_name(said.level), name);
    const bool fresh = table.emplace(key(e.a, e.b), e.ab).second;
    if (!fresh || !table.emplace(key(e.b, e.a), e.ba).second) refuse("is given twice for " + level_name(said.level), name);
  }
  return table;
}

CutPolicy overridden(const ParameterDocument::Level& said, CutPolicy otherwise, const HoneycombMap& map) {
  if (std::holds_alternative<PlanePolicy>(otherwise)) {
    refuse("parameters cannot stand beside a tangent policy", level_name(said.level));
  }
  auto edges = std::make_shared<const HalfEdgeTable>(edge_table(said, map));
  return HalfEdgePolicy([edges = std::move(edges), sizes = said.sizes, otherwise = std::move(otherwise)](
                            const HoneycombMap& m, HalfEdgeId id) -> QuadraticField {
    const auto h = static_cast<std::uint32_t>(id);
    if (const auto e = edges->find(key(m.origin(h), m.target(h))); e != edges->end()) return e->second;
    const std::size_t smaller = std::min(m.facet_size(m.facet(h)), m.facet_size(m.facet(m.twin(h))));
    if (const auto s = sizes.find(smaller); s != sizes.end()) return s->second;
    return asked_parameter(m, otherwise, h);
  });
}

}  // namespace

PolicySchedule document_policy(const ParameterDocument& document, Arithmetic arithmetic, const PlaneBody& base) {
  std::map<std::uint32_t, ParameterDocument::Level> levels;
  for (const auto& level : document.levels) {
    if (!levels.emplace(level.level, level).second) refuse("is given twice", level_name(level.level));
  }
  return [otherwise = parse_policy(document.default_policy, arithmetic, base), levels = std::move(levels)](const HoneycombMap& map) {
    const auto said = levels.find(map.level());
    return said == levels.end() ? otherwise(map) : overridden(said->second, otherwise(map), map);
  };
}

PlanePolicy tangent_policy(std::vector<Point3<double>> points) {
  if (points.empty()) refuse("the body to touch has no points", "");
  PlanePolicy policy = tangent_policy(Ellipsoid{});  // for its normal
  policy.offset = [points = std::move(points)](const std::array<double, 3>& n) {
    double d = -std::numeric_limits<double>::infinity();
    for (const auto& p : points) d = std::max(d, n[0] * p.x + n[1] * p.y + n[2] * p.z);
    return d;
  };
  return policy;
}

}  // namespace hexact
