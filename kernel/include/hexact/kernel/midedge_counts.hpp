// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/midedge_map.hpp"

namespace hexact {

/// Sizes of a level; doubles, so that no number of steps overflows them. Exact below 2^53.
struct MidedgeCounts {
  double vertices = 0, edges = 0, facets = 0;
  friend bool operator==(const MidedgeCounts&, const MidedgeCounts&) = default;
};

/// The sizes after `steps` further single steps (under `dual` on an open mesh an even number), without making them.
/// Exact but for `drop` on open meshes, where it is exact for one step and an upper bound for more, often a wide one: the
/// boundary eats the mesh up, and how fast depends on all of it. Cost: O(H) and, under `close`, O(steps · boundary).
[[nodiscard]] MidedgeCounts midedge_counts_after(const MidedgeMap& map, unsigned steps, MidedgeBoundary boundary);

}  // namespace hexact
