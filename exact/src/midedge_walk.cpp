// SPDX-License-Identifier: LGPL-3.0-or-later
#include "midedge_walk.hpp"

namespace hexact::detail {

std::array<std::uint32_t, kNet> midedge_sector(MidedgeWalk& walk, std::uint32_t h) {
  std::array<std::uint32_t, kNet> v{};
  v[0] = walk.start_of(h);
  for (std::uint32_t i = 0; i < 2; ++i) {
    walk.expect_valence_4(h);
    // Facet across the axis: (s, i, 0) → (p, 0, i) → (p, 0, i + 1) → (s, i + 1, 0) → (s, i, 0).
    std::uint32_t side = walk.across(walk.on(h, 3));  // (s, i, 0) → (s, i + 1, 0) in cell (i, 0)
    walk.expect_valence_4(walk.on(side, 3));
    for (std::uint32_t j = 0; j < 2; ++j) {
      v[3 * (i + 1) + j] = walk.start_of(walk.on(side, 1));
      v[3 * (i + 1) + j + 1] = walk.start_of(walk.on(side, 2));
      v[3 * i + j + 1] = walk.start_of(walk.on(side, 3));
      if (j == 0) side = walk.across(walk.on(side, 2));  // (s, i, 1) → (s, i + 1, 1) in cell (i, 1)
    }
    if (i == 0) h = walk.across(walk.on(h, 2));
  }
  return v;
}

}  // namespace hexact::detail
