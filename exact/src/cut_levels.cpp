// SPDX-License-Identifier: LGPL-3.0-or-later
#include "cut_levels.hpp"

#include <utility>

namespace hexact::detail {
namespace {

/// Corner h of the old loops is vertex h, and H + v the vertex where the three cut edges of v meet; old facets keep
/// their corners, and each edge becomes a hexagon.
HoneycombMap edge_cut(const HoneycombMap& map) {
  const auto corners = static_cast<std::uint32_t>(map.half_edge_count());
  FacetLoops loops;
  loops.reserve(map.facet_count() + map.edge_count(), 4 * map.half_edge_count());
  const auto add = [&](std::uint32_t v) { loops.add_corner(make_id<VertexId>(v)); };
  for (std::uint32_t f = 0; f < map.facet_count(); ++f) {
    for (std::uint32_t i = 0; i < map.facet_size(f); ++i) add(map.facet_start(f) + i);
    loops.close_loop();
  }
  for (const std::uint32_t h : forward_half_edges(map)) {
    const std::uint32_t g = map.twin(h);
    for (const std::uint32_t v : {corners + map.origin(h), map.next(g), g, corners + map.origin(g), map.next(h), h}) add(v);
    loops.close_loop();
  }
  return HoneycombMap(loops, map.half_edge_count() + map.vertex_count());
}

}  // namespace

std::vector<std::uint32_t> forward_half_edges(const HoneycombMap& map) {
  std::vector<std::uint32_t> out;
  out.reserve(map.edge_count());
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    if (map.origin(h) < map.target(h)) out.push_back(h);
  }
  return out;
}

NextCut next_cut(const HoneycombMap& map, std::span<const FacetAddress> addresses, std::uint32_t number) {
  std::size_t end = map.facet_count();
  while (end < addresses.size() && addresses[end].level == number) ++end;
  NextCut next{std::nullopt, end - map.facet_count()};
  if (next.found == map.vertex_count()) next.kind = CutKind::corners;
  if (next.found == map.edge_count()) next.kind = CutKind::edges;
  return next;
}

CutLevel after_cut(CutLevel level, CutKind kind, std::uint32_t number) {
  const std::size_t added = kind == CutKind::corners ? level.map.vertex_count() : level.map.edge_count();
  for (std::size_t i = 0; i < added; ++i) level.addresses.push_back({number, make_id<VertexId>(i)});
  return {kind == CutKind::corners ? level.map.refined() : edge_cut(level.map), std::move(level.addresses)};
}

Fault difference_fault(const CutLevel& level, const PlaneBody& body) {
  const FacetLoops loops = level.map.loops();
  for (std::size_t f = 0; f < loops.size(); ++f) {
    const auto expected = loops[f], found = body.loops[f];
    if (!std::equal(expected.begin(), expected.end(), found.begin(), found.end())) {
      return facet_name(f) + ": its loop is not the one that the steps make";
    }
    if (!(body.addresses[f] == level.addresses[f])) return facet_name(f) + ": level or parent is not the one of its place";
  }
  return {};
}

Triples triples_of(const HoneycombMap& map) {
  Triples triples(map.vertex_count());
  for (std::uint32_t v = 0; v < map.vertex_count(); ++v) {
    const auto f = map.facets_at(v);
    triples[v] = {make_id<FacetId>(f[0]), make_id<FacetId>(f[1]), make_id<FacetId>(f[2])};
  }
  return triples;
}

}  // namespace hexact::detail
