// SPDX-License-Identifier: LGPL-3.0-or-later
#include "plane_text.hpp"

#include <algorithm>

namespace hexact::io {
namespace {

/// A facet at a vertex, and the vertices before and after it in the facet's loop.
struct Corner {
  std::uint32_t facet = 0, previous = 0, next = 0;
};

/// The facets around a vertex. In a closed orientable map the facet that follows counter-clockwise leaves the vertex
/// along the edge by which this one arrives; where the loops do not fit together the order is that of the numbers.
std::array<FacetId, 3> ordered(std::array<Corner, 3> corners) {
  std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) { return a.facet < b.facet; });
  if (corners[2].next == corners[0].previous) std::swap(corners[1], corners[2]);
  return {FacetId{corners[0].facet}, FacetId{corners[1].facet}, FacetId{corners[2].facet}};
}

}  // namespace

DerivedTriples derive_triples(const FacetLoops& loops, std::size_t vertex_count) {
  std::vector<std::array<Corner, 3>> corners(vertex_count);
  std::vector<std::uint32_t> counts(vertex_count);
  for (std::size_t f = 0; f < loops.size(); ++f) {
    const auto loop = loops[f];
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const std::size_t v = index(loop[i]);
      const std::uint32_t slot = counts[v]++;
      if (slot >= 3) continue;
      corners[v][slot] = {static_cast<std::uint32_t>(f),
                          static_cast<std::uint32_t>(loop[i == 0 ? loop.size() - 1 : i - 1]),
                          static_cast<std::uint32_t>(loop[i + 1 == loop.size() ? 0 : i + 1])};
    }
  }
  DerivedTriples result;
  const auto wrong = std::find_if(counts.begin(), counts.end(), [](std::uint32_t n) { return n != 3; });
  if (wrong != counts.end()) {
    result.offending = static_cast<std::size_t>(wrong - counts.begin());
    result.facets = *wrong;
    return result;
  }
  result.triples.resize(vertex_count);
  for (std::size_t v = 0; v < vertex_count; ++v) result.triples[v] = ordered(corners[v]);
  return result;
}

}  // namespace hexact::io
