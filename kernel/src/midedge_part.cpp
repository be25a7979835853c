// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/kernel/midedge_part.hpp"

namespace hexact {
namespace {

/// Calls `visit(half-edge)` for the half-edges that leave the origin of h, in its fan of facets.
template <class Visit>
void around_origin(const MidedgeMap& map, std::uint32_t h, const Visit& visit) {
  std::uint32_t g = h;
  do {
    visit(g);
    g = map.twin(map.previous(g));
  } while (g != kNoTwin && g != h);
  if (g == h) return;
  for (g = map.twin(h); g != kNoTwin; g = map.twin(g)) {
    g = map.next(g);
    visit(g);
  }
}

/// The facets asked for, then ring by ring.
std::vector<std::uint32_t> facets_within(const MidedgeMap& map, std::span<const std::uint32_t> facets, unsigned rings, std::vector<char>& kept) {
  std::vector<std::uint32_t> list(facets.begin(), facets.end());
  for (const std::uint32_t f : list) {
    HEXACT_EXPECTS(f < map.facet_count() && kept[f] == 0);
    kept[f] = 1;
  }
  std::size_t begin = 0;
  for (unsigned ring = 0; ring < rings; ++ring) {
    const std::size_t end = list.size();
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t start = map.facet_start(list[i]), size = map.facet_size(list[i]);
      for (std::uint32_t h = start; h < start + size; ++h) {
        around_origin(map, h, [&](std::uint32_t g) {
          const std::uint32_t f = map.facet(g);
          if (kept[f] == 0) list.push_back(f);
          kept[f] = 1;
        });
      }
    }
    begin = end;
  }
  return list;
}

/// Numbers the vertices of the part, one for each fan of facets that are kept.
class VertexNumbers {
 public:
  VertexNumbers(const MidedgeMap& map, const std::vector<char>& kept) : map_(map), kept_(kept), number_(map.half_edge_count(), kNoTwin) {}

  std::uint32_t operator()(std::uint32_t h) {
    if (number_[h] != kNoTwin) return number_[h];
    // Back to the beginning of the fan within the part, then forward to its end.
    std::uint32_t first = h;
    for (std::uint32_t t = inside(map_.twin(first)); t != kNoTwin && map_.next(t) != h; t = inside(map_.twin(first))) first = map_.next(t);
    for (std::uint32_t g = first; g != kNoTwin && number_[g] == kNoTwin; g = inside(map_.twin(map_.previous(g)))) {
      number_[g] = static_cast<std::uint32_t>(vertices_.size());
    }
    vertices_.push_back(map_.origin(h));
    return number_[h];
  }
  std::vector<std::uint32_t> take() { return std::move(vertices_); }

 private:
  [[nodiscard]] std::uint32_t inside(std::uint32_t h) const { return h != kNoTwin && kept_[map_.facet(h)] != 0 ? h : kNoTwin; }

  const MidedgeMap& map_;
  const std::vector<char>& kept_;
  std::vector<std::uint32_t> number_;  ///< of the vertex that a half-edge leaves
  std::vector<std::uint32_t> vertices_;
};

}  // namespace

MidedgePart midedge_part(const MidedgeMap& map, std::span<const std::uint32_t> facets, unsigned rings) {
  std::vector<char> kept(map.facet_count(), 0);
  const std::vector<std::uint32_t> list = facets_within(map, facets, rings, kept);
  VertexNumbers number(map, kept);
  FacetLoops loops;
  for (const std::uint32_t f : list) {
    const std::uint32_t start = map.facet_start(f), size = map.facet_size(f);
    for (std::uint32_t h = start; h < start + size; ++h) loops.add_corner(make_id<VertexId>(number(h)));
    loops.close_loop();
  }
  std::vector<std::uint32_t> vertices = number.take();
  const std::size_t count = vertices.size();
  return {MidedgeMap(loops, count), std::move(vertices)};
}

}  // namespace hexact
