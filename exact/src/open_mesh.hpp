// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/mesh_topology.hpp"
#include "hexact/kernel/polygon_soup.hpp"

#include <vector>

namespace hexact::detail {

/// Throws InvalidInput unless the loops form one connected oriented manifold, possibly with a boundary. Vertices
/// that no facet uses are accepted.
inline void require_oriented_manifold(const FacetLoops& loops, std::size_t vertex_count) {
  std::vector<Finding> findings = analyse_topology(loops, vertex_count).findings;
  std::erase_if(findings, [](const Finding& f) { return f.code == "HasBoundary" || f.code == "UnusedVertex"; });
  if (!findings.empty()) throw InvalidInput(std::move(findings));
}

/// For each vertex its half-edge with the smallest number, or kNoTwin when the vertex is unused or on a boundary.
inline std::vector<std::uint32_t> interior_starts(const HalfEdges& edges, std::size_t vertex_count) {
  std::vector<std::uint32_t> first(vertex_count, kNoTwin);
  for (std::uint32_t h = 0; h < edges.size(); ++h) {
    if (first[edges.origin[h]] == kNoTwin) first[edges.origin[h]] = h;
  }
  for (std::uint32_t h = 0; h < edges.size(); ++h) {
    if (edges.twin[h] == kNoTwin) first[edges.origin[h]] = first[edges.target(h)] = kNoTwin;
  }
  return first;
}

/// The soup without the points that no facet names.
template <class S>
PolygonSoup<S> without_unused_points(const PolygonSoup<S>& soup) {
  std::vector<std::uint32_t> number(soup.points.size(), kNoTwin);
  for (const VertexId v : soup.facets.corners()) number[index(v)] = 0;
  PolygonSoup<S> result;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == kNoTwin) continue;
    number[v] = static_cast<std::uint32_t>(result.points.size());
    result.points.push_back(soup.points[v]);
  }
  for (std::size_t f = 0; f < soup.facets.size(); ++f) {
    for (const VertexId v : soup.facets[f]) result.facets.add_corner(make_id<VertexId>(number[index(v)]));
    result.facets.close_loop();
  }
  result.addresses = soup.addresses;
  return result;
}

}  // namespace hexact::detail
