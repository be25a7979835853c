// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/honeycomb_map.hpp"
#include "hexact/kernel/raw_vector.hpp"

#include <array>
#include <cstdint>

namespace hexact {

/// Numbers of the edges of a map, in the order of their first half-edges: those whose origin has a smaller number than
/// their target. This is the order in which a chamfer step adds planes and facets.
struct EdgeNumbering {
  RawVector<std::uint32_t> edge;       ///< for each half-edge, the number of its edge
  RawVector<std::uint32_t> half_edge;  ///< for each edge, its first half-edge
  /// For each vertex, its edges in the order of `HoneycombMap::star`.
  RawVector<std::array<std::uint32_t, 3>> at_vertex;

  /// Whether h is the first half-edge of its edge.
  [[nodiscard]] bool is_first(std::uint32_t h) const noexcept { return half_edge[edge[h]] == h; }
};

/// Numbers the edges. Cost: O(H), in parallel.
[[nodiscard]] EdgeNumbering number_edges(const HoneycombMap& map);

}  // namespace hexact
