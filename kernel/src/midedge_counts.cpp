// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/kernel/midedge_counts.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace hexact {
namespace {

struct Boundary {
  double edges = 0;
  double vertices = 0;                   ///< fewer than edges where the surface touches itself
  double ends = 0;                       ///< inner edges that end at a boundary vertex
  std::vector<std::vector<int>> loops;   ///< edges at each boundary vertex, in order along the boundary, 4 for more
};

/// Edges at each vertex along each boundary loop.
Boundary boundary_of(const MidedgeMap& map) {
  Boundary result;
  std::vector<std::uint32_t> edges_at(map.vertex_count(), 0);
  std::vector<std::uint32_t> leaving(map.vertex_count(), kNoTwin);
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    ++edges_at[map.origin(h)];
    if (map.twin(h) != kNoTwin) continue;
    ++edges_at[map.target(h)];
    leaving[map.origin(h)] = h;
    ++result.edges;
  }
  result.vertices = static_cast<double>(std::count_if(leaving.begin(), leaving.end(), [](std::uint32_t h) { return h != kNoTwin; }));
  for (std::uint32_t v = 0; v < leaving.size(); ++v) {
    if (leaving[v] == kNoTwin) continue;
    result.loops.emplace_back();
    for (std::uint32_t w = v; leaving[w] != kNoTwin;) {
      result.loops.back().push_back(static_cast<int>(std::min(edges_at[w], 4u)));
      result.ends += edges_at[w] - 2;
      const std::uint32_t h = std::exchange(leaving[w], kNoTwin);
      w = map.target(h);
    }
  }
  return result;
}

/// One `close` step along the boundary: the middle of each boundary edge gets one edge at an end with 2 edges, else two.
/// Returns the number of boundary vertices that become facets.
double close_loops(std::vector<std::vector<int>>& loops) {
  double facets = 0;
  for (std::vector<int>& loop : loops) {
    std::vector<int> after;
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int a = loop[i], b = loop[(i + 1) % loop.size()];
      facets += a >= 3 ? 1 : 0;
      after.push_back((a >= 3 ? 2 : 1) + (b >= 3 ? 2 : 1));
    }
    loop = std::move(after);
  }
  return facets;
}

}  // namespace

MidedgeCounts midedge_counts_after(const MidedgeMap& map, unsigned steps, MidedgeBoundary boundary) {
  MidedgeCounts n{static_cast<double>(map.vertex_count()), static_cast<double>(map.edge_count()),
                  static_cast<double>(map.facet_count())};
  if (map.closed()) {
    for (unsigned i = 0; i < steps; ++i) n = {n.edges, 2 * n.edges, n.facets + n.vertices};
    return n;
  }
  Boundary rim = boundary_of(map);
  double inner_vertices = n.vertices - rim.vertices;
  for (unsigned i = 0; i < steps; ++i) {
    const double inner_edges = n.edges - rim.edges, corners = 2 * inner_edges + rim.edges;
    if (boundary == MidedgeBoundary::dual) {
      ++i;
      n = {corners, corners + 2 * inner_edges, n.facets + inner_edges + inner_vertices};
      rim.edges += rim.ends;
      rim.ends *= 2;
      inner_vertices = n.vertices - rim.edges;
    } else {
      const double closing = boundary == MidedgeBoundary::close ? close_loops(rim.loops) : 0;
      n = {n.edges, corners + closing, n.facets + inner_vertices + closing};
      inner_vertices = inner_edges;
      if (boundary == MidedgeBoundary::drop) rim.edges = 0;  // the boundary grows: inner edges are counted too high
    }
  }
  return n;
}

}  // namespace hexact
