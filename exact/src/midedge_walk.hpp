// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/midedge_map.hpp"
#include "midedge_operator.hpp"

#include <array>
#include <cstdint>

namespace hexact::detail {

/// Walks from half-edge to half-edge through quadrilaterals; remembers when something else was met.
class MidedgeWalk {
 public:
  explicit MidedgeWalk(const MidedgeMap& map) : map_(map) {}

  /// The half-edge on the other side, if it belongs to a quadrilateral.
  std::uint32_t across(std::uint32_t h) {
    const std::uint32_t t = failed_ ? kNoTwin : map_.twin(h);
    if (t != kNoTwin && map_.facet_size(map_.facet(t)) == 4) return t;
    failed_ = true;
    return h;
  }
  [[nodiscard]] std::uint32_t on(std::uint32_t h, int steps) const {
    for (int i = 0; i < steps; ++i) h = map_.next(h);
    return h;
  }
  [[nodiscard]] std::uint32_t start_of(std::uint32_t h) const { return map_.origin(h); }

  /// The vertex that h leaves has to be an inner one with four edges.
  void expect_valence_4(std::uint32_t h) {
    std::uint32_t g = h;
    for (int i = 1; i <= 4 && !failed_; ++i) {
      g = map_.twin(map_.previous(g));
      failed_ = g == kNoTwin || (g == h) != (i == 4);
    }
  }
  /// h has to run along the boundary.
  void expect_boundary(std::uint32_t h) { failed_ = failed_ || map_.twin(h) != kNoTwin; }
  [[nodiscard]] bool failed() const { return failed_; }

 private:
  const MidedgeMap& map_;
  bool failed_ = false;
};

/// The sector to the left of axis s: `h` runs from (s, 0, 0) to (s − 1, 0, 0) in the first facet across the axis. Entry
/// 3i + j is the vertex i steps along axis s and j along axis s + 1. The walk fails unless the cells are quadrilaterals
/// and the vertices with i, j < 2, whose surroundings the next net depends on, are inner ones of valence 4.
[[nodiscard]] std::array<std::uint32_t, kNet> midedge_sector(MidedgeWalk& walk, std::uint32_t h);

}  // namespace hexact::detail
