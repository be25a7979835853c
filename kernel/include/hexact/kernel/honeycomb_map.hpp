// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/facet_loops.hpp"
#include "hexact/kernel/ids.hpp"
#include "hexact/kernel/raw_vector.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hexact {

/// A closed map in which every vertex has valence 3, refined by planar honeycomb steps.
///
/// Half-edges are numbered facet by facet: the half-edge of corner j of facet f leaves that corner, and
/// the facets behind the initial ones are all hexagons, so facet and successor are index arithmetic.
/// A honeycomb step (H half-edges, V vertices, F facets before it) makes
///   vertex h        on half-edge h,                                  V' = H
///   facet f < F     the old facet, corner h being vertex h,          half-edges 0 … H−1 as before
///   facet F + v     the hexagon that cuts corner v, half-edges H + 6v … H + 6v + 5
/// which is the canonical numbering of planar honeycomb levels. The hexagon lists, for the facets
/// around v counter-clockwise from the one with the smallest number, vertex h and then the vertex of
/// the half-edge before h, h being the half-edge that leaves v in that facet.
class HoneycombMap {
 public:
  /// Builds level 0. Throws InvalidInput (NotManifold, HasBoundary, NotTrivalent, NotConnected) with
  /// all findings. Cost: O(H log H).
  explicit HoneycombMap(const FacetLoops& loops, std::size_t vertex_count);

  [[nodiscard]] std::size_t vertex_count() const noexcept { return twin_.size() / 3; }
  [[nodiscard]] std::size_t half_edge_count() const noexcept { return twin_.size(); }
  [[nodiscard]] std::size_t edge_count() const noexcept { return twin_.size() / 2; }
  [[nodiscard]] std::size_t facet_count() const noexcept {
    return base_facets_ + (half_edge_count() - base_half_edges_) / 6;
  }
  [[nodiscard]] std::size_t base_facet_count() const noexcept { return base_facets_; }
  [[nodiscard]] std::uint32_t level() const noexcept { return level_; }
  /// Number of facets of level l, 0 <= l <= level().
  [[nodiscard]] std::size_t facet_count_at(std::uint32_t l) const noexcept { return level_facets_[l]; }

  [[nodiscard]] std::uint32_t twin(std::uint32_t h) const noexcept { return twin_[h]; }
  [[nodiscard]] std::uint32_t origin(std::uint32_t h) const noexcept { return origin_[h]; }
  [[nodiscard]] std::uint32_t target(std::uint32_t h) const noexcept { return origin_[next(h)]; }
  [[nodiscard]] std::uint32_t facet(std::uint32_t h) const noexcept {
    return h < base_half_edges_ ? base_facet_[h] : hexagon_of(h);
  }
  [[nodiscard]] std::uint32_t next(std::uint32_t h) const noexcept {
    if (h < base_half_edges_) return base_next_[h];
    const std::uint32_t i = (h - base_half_edges_) % 6;
    return i == 5 ? h - 5 : h + 1;
  }
  [[nodiscard]] std::uint32_t previous(std::uint32_t h) const noexcept {
    if (h < base_half_edges_) return base_previous_[h];
    const std::uint32_t i = (h - base_half_edges_) % 6;
    return i == 0 ? h + 5 : h - 1;
  }
  [[nodiscard]] std::uint32_t facet_size(std::uint32_t f) const noexcept {
    return f < base_facets_ ? base_size_[f] : 6;
  }
  /// First half-edge of facet f.
  [[nodiscard]] std::uint32_t facet_start(std::uint32_t f) const noexcept {
    return f < base_facets_ ? base_start_[f]
                            : base_half_edges_ + 6 * (f - static_cast<std::uint32_t>(base_facets_));
  }
  /// The three half-edges that leave v, counter-clockwise, the first in the facet with the smallest number.
  [[nodiscard]] std::array<std::uint32_t, 3> star(std::uint32_t v) const noexcept {
    const std::uint32_t a = level_ == 0 ? base_first_[v] : v;
    const std::uint32_t b = twin_[previous(a)];
    return {a, b, twin_[previous(b)]};
  }
  /// The three facets at v in the order of `star`.
  [[nodiscard]] std::array<std::uint32_t, 3> facets_at(std::uint32_t v) const noexcept {
    const auto s = star(v);
    return {facet(s[0]), facet(s[1]), facet(s[2])};
  }
  /// Position (0, 1, 2) of h in `star(origin(h))`. Cost: O(1).
  [[nodiscard]] std::uint32_t slot(std::uint32_t h) const noexcept {
    if (level_ == 0) return base_slot_[h];
    return h < parent_half_edges_ ? 0 : 1 + ((h - parent_half_edges_) & 1);
  }

  /// Level and parent of facet f.
  [[nodiscard]] std::uint32_t facet_level(std::uint32_t f) const noexcept;
  /// Number of the vertex of level facet_level(f) − 1 that facet f cut off; f must not be a base facet.
  [[nodiscard]] std::uint32_t facet_parent(std::uint32_t f) const noexcept;

  /// The map after one honeycomb step. Cost: O(H), in parallel, without search.
  /// Throws ResourceLimit when the half-edges would not fit 32 bits.
  [[nodiscard]] HoneycombMap refined() const;

  /// The vertex loops of all facets.
  [[nodiscard]] FacetLoops loops() const;

 private:
  HoneycombMap() = default;
  [[nodiscard]] std::uint32_t hexagon_of(std::uint32_t h) const noexcept {
    return static_cast<std::uint32_t>(base_facets_) + (h - base_half_edges_) / 6;
  }

  RawVector<std::uint32_t> twin_, origin_;
  std::vector<std::uint32_t> base_facet_, base_next_, base_previous_, base_slot_, base_first_;
  std::vector<std::uint32_t> base_size_, base_start_;
  std::vector<std::size_t> level_facets_;
  std::uint32_t base_half_edges_ = 0;
  std::uint32_t parent_half_edges_ = 0;
  std::uint32_t level_ = 0;
  std::size_t base_facets_ = 0;
};

}  // namespace hexact
