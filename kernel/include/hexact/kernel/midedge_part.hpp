// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/midedge_map.hpp"

#include <cstdint>
#include <span>
#include <vector>

namespace hexact {

/// Some facets of a level and what is around them, as a mesh of its own.
struct MidedgePart {
  MidedgeMap map;                       ///< of level 0; the facets that were asked for come first, in their order
  std::vector<std::uint32_t> vertices;  ///< for each vertex of the part its number in the whole
};

/// The part within `rings` rings around the facets asked for; a ring is all facets that share a vertex with those before.
///
/// The point of a double step in a corner of a facet depends on the facets that share a vertex with it. So where r rings
/// of a part are as in the whole, 2(r − 1) rings are so after a double step or two single ones: two rings around a facet
/// are enough for ever. Beyond them, the edge of the part takes the rules of a boundary, and its points mean nothing.
/// Where the whole hangs together around a vertex but the part does not, the vertex is doubled, so the part is a manifold.
/// Preconditions: different facets of the map. Cost: O(V + H) memory and time of the whole, O(n log n) for n half-edges
/// of the part.
[[nodiscard]] MidedgePart midedge_part(const MidedgeMap& map, std::span<const std::uint32_t> facets, unsigned rings);

}  // namespace hexact
