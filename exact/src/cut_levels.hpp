// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "convex_surface.hpp"
#include "hexact/kernel/honeycomb_map.hpp"
#include "hexact/kernel/progress.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

// The levels of the claim corner-cut-of: their maps, made again from the first one, and the signs each has to have.
namespace hexact::detail {

/// What a step cuts off with one plane each: the vertices (honeycomb) or the edges (chamfer).
enum class CutKind { corners, edges };

/// A level with the address of each facet, beginning with those of level 0.
struct CutLevel {
  HoneycombMap map;
  std::vector<FacetAddress> addresses;
};

/// The half-edge of each edge that runs from the smaller to the larger vertex, ascending: their order is that of edges.
[[nodiscard]] std::vector<std::uint32_t> forward_half_edges(const HoneycombMap& map);

/// How the planes that follow those of `map` with the level `number` were made: as many as the map has vertices or
/// edges (3V = 2E, so never both). nullopt: neither; `found` of them.
struct NextCut {
  std::optional<CutKind> kind;
  std::size_t found = 0;
};
[[nodiscard]] NextCut next_cut(const HoneycombMap& map, std::span<const FacetAddress> addresses, std::uint32_t number);

/// The level after the step that makes level `number`. Cost: O(H log H).
[[nodiscard]] CutLevel after_cut(CutLevel level, CutKind kind, std::uint32_t number);

/// Where loops and addresses of the body differ from those of the level; both have the same number of facets.
[[nodiscard]] Fault difference_fault(const CutLevel& level, const PlaneBody& body);

/// Each vertex of the map, in its order of facets.
[[nodiscard]] Triples triples_of(const HoneycombMap& map);

/// A level that is convex: each of its corners, or both ends of each of its edges, strictly beyond their own plane.
template <class Planes>
Fault kept_fault(const Planes& planes, const HoneycombMap& map, const Triples& triples, CutKind kind) {
  const auto kept = [&](std::size_t v, std::size_t own) {  // det3 > 0 by convexity
    const auto& t = triples[v];
    return sign_det4(planes, index(t[0]), index(t[1]), index(t[2]), own) >= 0;
  };
  const auto text = [&](const std::string& element, std::size_t v, std::size_t own) {
    const auto& t = triples[v];
    return element + ": " + vertex_name(v) + " is not beyond plane " + std::to_string(own) + ", det4 = " +
           det4_text(planes, index(t[0]), index(t[1]), index(t[2]), own);
  };
  const std::size_t facets = map.facet_count();
  if (kind == CutKind::corners) {
    const std::size_t v = first_where(triples.size(), [&](std::size_t i) { return kept(i, facets + i); });
    return v == triples.size() ? Fault{} : text(vertex_name(v), v, facets + v);
  }
  const std::vector<std::uint32_t> edges = forward_half_edges(map);
  const std::size_t e = first_where(edges.size(), [&](std::size_t i) {
    return kept(map.origin(edges[i]), facets + i) || kept(map.target(edges[i]), facets + i);
  });
  if (e == edges.size()) return {};
  const std::size_t a = map.origin(edges[e]), b = map.target(edges[e]);
  return text(edge_name(a, b), kept(a, facets + e) ? a : b, facets + e);
}

/// Whether `body` comes from the trivalent body `base`, whose planes are the first of `planes` already, by cutting
/// corners or edges level by level: the counts of planes, each level before the last convex with what it cuts off
/// strictly beyond its planes, and loops and addresses of the last. That the last is convex is another claim. The
/// first step makes level `first`; `visit(map, kind)` sees each level before the last, when it has passed.
template <class Planes, class Visit>
Fault replay_fault(const Planes& planes, const PlaneBody& body, const PlaneBody& base, std::uint32_t first, const Visit& visit,
                   const ProgressPart& progress = {}) {
  CutLevel level{HoneycombMap(base.loops, base.vertex_count()), base.addresses};
  level.addresses.resize(base.plane_count());
  if (body.addresses.size() != planes.size()) return "the planes have no levels";
  for (std::uint32_t number = first; level.map.facet_count() < planes.size(); ++number) {
    progress.report(static_cast<double>(level.map.facet_count()) / static_cast<double>(planes.size()));
    const std::string at = "level " + std::to_string(number) + ": ";
    const NextCut next = next_cut(level.map, body.addresses, number);
    if (!next.kind) {
      return at + std::to_string(next.found) + " planes follow, one for each of " + std::to_string(level.map.vertex_count()) +
             " vertices or of " + std::to_string(level.map.edge_count()) + " edges were expected";
    }
    const FacetLoops loops = level.map.loops();
    const Triples triples = triples_of(level.map);
    if (Fault fault = convex_fault(planes, loops, triples, analyse_topology(loops, triples.size())); !fault.empty()) {
      return "level " + std::to_string(number - 1) + ": " + fault;
    }
    if (Fault fault = kept_fault(planes, level.map, triples, *next.kind); !fault.empty()) return at + fault;
    visit(level.map, *next.kind);
    level = after_cut(std::move(level), *next.kind, number);
  }
  return difference_fault(level, body);
}

}  // namespace hexact::detail
