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

struct EdgeNumbering;

/// What a step cuts: every vertex (planar honeycombs) or every edge (chamfers).
enum class Cut : std::uint8_t { vertices, edges };

/// A closed map in which every vertex has valence 3, refined by honeycomb steps and by chamfer steps in any order.
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
///
/// A chamfer step makes, edges being numbered as EdgeNumbering does,
///   vertex h        in the corner of h: origin of h, facet of h,      V' = H + V = 4V
///   vertex H + v    where the three cut edges of v meet
///   facet f < F     the old facet, corner h being vertex h,           half-edges 0 … H−1 as before
///   facet F + e     the hexagon that cuts edge e,                     half-edges H + 6e … H + 6e + 5
/// The hexagon of the edge with half-edges h (a→b, a < b) and g = twin h lists H + a, next(g), g, H + b, next(h), h.
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
    const std::uint32_t a = first(v);
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
    if (h < parent_half_edges_) return 0;
    const std::uint32_t i = h - parent_half_edges_;
    if (cuts_.back() == Cut::vertices) return 1 + (i & 1);
    return i % 3 == 0 ? slot_by_search(h) : i % 3;
  }

  /// Level and parent of facet f.
  [[nodiscard]] std::uint32_t facet_level(std::uint32_t f) const noexcept;
  /// Number of the vertex, or edge, of level facet_level(f) − 1 that facet f cut off; f must not be a base facet.
  [[nodiscard]] std::uint32_t facet_parent(std::uint32_t f) const noexcept;
  /// What the step to level l cut, 1 <= l <= level().
  [[nodiscard]] Cut cut_at(std::uint32_t l) const noexcept { return cuts_[l - 1]; }

  /// The map after one honeycomb step. Cost: O(H), in parallel, without search.
  /// Throws ResourceLimit when the half-edges would not fit 32 bits.
  [[nodiscard]] HoneycombMap refined() const;
  /// The map after one chamfer step; `edges` is the numbering of this map. Cost and exceptions as `refined`.
  [[nodiscard]] HoneycombMap refined_at_edges(const EdgeNumbering& edges) const;

  /// The vertex loops of all facets.
  [[nodiscard]] FacetLoops loops() const;

 private:
  HoneycombMap() = default;
  /// The next level's map with its arrays allocated, not filled.
  [[nodiscard]] HoneycombMap successor(Cut cut) const;
  /// The half-edge that leaves v in the facet with the smallest number.
  [[nodiscard]] std::uint32_t first(std::uint32_t v) const noexcept {
    if (level_ == 0) return base_first_[v];
    return v < parent_half_edges_ ? v : edge_first_[v - parent_half_edges_];
  }
  [[nodiscard]] std::uint32_t slot_by_search(std::uint32_t h) const noexcept {
    const auto s = star(origin_[h]);
    return s[0] == h ? 0 : s[1] == h ? 1 : 2;
  }
  [[nodiscard]] std::uint32_t hexagon_of(std::uint32_t h) const noexcept {
    return static_cast<std::uint32_t>(base_facets_) + (h - base_half_edges_) / 6;
  }

  RawVector<std::uint32_t> twin_, origin_;
  std::vector<std::uint32_t> base_facet_, base_next_, base_previous_, base_slot_, base_first_;
  std::vector<std::uint32_t> base_size_, base_start_;
  RawVector<std::uint32_t> edge_first_;  ///< after a chamfer step: `first` of the vertices H + v
  std::vector<std::size_t> level_facets_;
  std::vector<Cut> cuts_;  ///< of the steps to levels 1, 2, …
  std::uint32_t base_half_edges_ = 0;
  std::uint32_t parent_half_edges_ = 0;
  std::uint32_t level_ = 0;
  std::size_t base_facets_ = 0;
};

}  // namespace hexact
