// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/errors.hpp"
#include "hexact/kernel/facet_loops.hpp"
#include "hexact/kernel/mesh_topology.hpp"
#include "hexact/kernel/polygon_soup.hpp"
#include "hexact/kernel/raw_vector.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace hexact {

/// What becomes of the boundary of an open mesh; closed meshes do not ask.
enum class MidedgeBoundary {
  dual,   ///< two steps at once in the manner of Doo and Sabin: the mesh recedes by half a cell in all, always manifold
  close,  ///< a boundary vertex with 3 edges or more becomes a facet whose last edge closes the fan; always manifold
  drop,   ///< a boundary vertex becomes no facet: makes pinched vertices; what OpenMesh does, for comparison only
};

/// An oriented 2-manifold of polygons, with or without boundary, refined by Midedge steps.
///
/// Half-edges are numbered facet by facet: the half-edge of corner j of facet f leaves that corner. Edges are numbered
/// in the order in which half-edges first show them. A single step (H half-edges, V vertices, F facets before it) makes
///   vertex e        on edge e,
///   facet f < F     the old facet, corner j being the vertex on the edge that left corner j, half-edges 0 … H−1,
///   then            for each vertex, in order, the facet that cuts it off: the vertices on its edges, counter-clockwise
///                   from the half-edge with the smallest number (on a boundary: from its first edge).
/// A double step makes vertex h in the corner of half-edge h; facets: the old ones, then one quadrilateral for each
/// inner edge in order, then the inner vertices in order. On closed meshes it equals two single steps but for numbers.
///
/// Behind the first facets, the only ones that may have other sizes, all facets are quadrilaterals, so facet and
/// successor are index arithmetic; from the second step of a closed mesh on nothing is searched or counted any more.
class MidedgeMap {
 public:
  /// Builds level 0. Throws InvalidInput with all findings: those of `analyse_topology` but for HasBoundary and
  /// NotConnected (unused vertices are an error), and LowValence (inner vertex with fewer than 3 edges).
  /// Cost: O(H log H).
  explicit MidedgeMap(const FacetLoops& loops, std::size_t vertex_count);

  [[nodiscard]] std::size_t vertex_count() const noexcept { return vertices_; }
  [[nodiscard]] std::size_t half_edge_count() const noexcept { return origin_.size(); }
  [[nodiscard]] std::size_t edge_count() const noexcept { return (origin_.size() + boundary_) / 2; }
  [[nodiscard]] std::size_t facet_count() const noexcept {
    return listed_facets() + (half_edge_count() - listed_half_edges()) / 4;
  }
  /// Number of single steps made.
  [[nodiscard]] std::uint32_t level() const noexcept { return level_; }
  [[nodiscard]] bool closed() const noexcept { return boundary_ == 0; }
  /// Vertices at which several fans of facets meet; only `drop` makes them. Cost: O(H) on open meshes.
  [[nodiscard]] std::size_t pinched_vertex_count() const;

  /// The half-edge that runs the other way, or kNoTwin on the boundary.
  [[nodiscard]] std::uint32_t twin(std::uint32_t h) const noexcept { return twin_[h]; }
  [[nodiscard]] std::uint32_t origin(std::uint32_t h) const noexcept { return origin_[h]; }
  [[nodiscard]] std::uint32_t target(std::uint32_t h) const noexcept { return origin_[next(h)]; }
  [[nodiscard]] std::uint32_t facet(std::uint32_t h) const noexcept {
    return h < listed_half_edges() ? facet_of_[h] : listed_facets() + (h - listed_half_edges()) / 4;
  }
  [[nodiscard]] std::uint32_t facet_start(std::uint32_t f) const noexcept {
    return f < listed_facets() ? start_[f] : listed_half_edges() + 4 * (f - listed_facets());
  }
  [[nodiscard]] std::uint32_t facet_size(std::uint32_t f) const noexcept {
    return f < listed_facets() ? start_[f + 1] - start_[f] : 4;
  }
  [[nodiscard]] std::uint32_t next(std::uint32_t h) const noexcept {
    if (h < listed_half_edges()) {
      const std::uint32_t f = facet_of_[h];
      return h + 1 == start_[f + 1] ? start_[f] : h + 1;
    }
    return ((h - listed_half_edges()) & 3) == 3 ? h - 3 : h + 1;
  }
  [[nodiscard]] std::uint32_t previous(std::uint32_t h) const noexcept {
    if (h < listed_half_edges()) {
      const std::uint32_t f = facet_of_[h];
      return h == start_[f] ? start_[f + 1] - 1 : h - 1;
    }
    return ((h - listed_half_edges()) & 3) == 0 ? h + 3 : h - 1;
  }
  /// The vertex loop of facet f.
  [[nodiscard]] std::span<const std::uint32_t> loop(std::uint32_t f) const noexcept {
    return {origin_.data() + facet_start(f), facet_size(f)};
  }

  /// True from the second step of a closed mesh on: all vertices have valence 4, edge e is half-edge e < H/2, and
  /// half-edge v < V leaves vertex v.
  [[nodiscard]] bool regular() const noexcept { return regular_; }
  /// The number of the edge of every half-edge. Cost: O(H).
  [[nodiscard]] RawVector<std::uint32_t> edge_numbers() const;
  /// For every vertex the half-edge with which its fan of facets begins, counter-clockwise: on the boundary the one
  /// without a twin, else the one with the smallest number. Cost: O(H).
  [[nodiscard]] std::vector<std::uint32_t> fan_starts() const;

  /// The map after one single step. On an open mesh `boundary` must not be `dual`. Cost: O(H), in parallel where the
  /// map is regular. Throws ResourceLimit when the half-edges would not fit 32 bits.
  [[nodiscard]] MidedgeMap stepped(MidedgeBoundary boundary) const;
  /// The map after one double step. Cost and errors as above.
  [[nodiscard]] MidedgeMap double_stepped() const;

  /// The step that made facet f and the vertex of the level before that it cut off; level 0 without parent for the
  /// facets of the input. Both never change in later levels.
  [[nodiscard]] FacetAddress address(std::uint32_t f) const;
  /// The vertex loops of all facets.
  [[nodiscard]] FacetLoops loops() const;

 private:
  /// Facets made by one step: facet `first` + i cut off vertex parents[i], or vertex i where there is no list.
  struct Birth {
    std::uint32_t level = 0, first = 0;
    std::vector<std::uint32_t> parents;
  };

  MidedgeMap() = default;
  [[nodiscard]] std::uint32_t listed_facets() const noexcept { return static_cast<std::uint32_t>(start_.size() - 1); }
  [[nodiscard]] std::uint32_t listed_half_edges() const noexcept { return start_.back(); }
  void set_sizes(const std::vector<std::uint32_t>& further_sizes, const MidedgeMap& parent);
  void require_room(std::size_t half_edges) const;
  [[nodiscard]] MidedgeMap regular_step() const;
  [[nodiscard]] MidedgeMap general_step(MidedgeBoundary boundary) const;
  [[nodiscard]] std::uint32_t cut_vertex(const MidedgeMap& parent, std::uint32_t fan_start, std::uint32_t at);
  void lay_along_edge(const MidedgeMap& parent, std::uint32_t h, std::uint32_t quad);

  RawVector<std::uint32_t> origin_, twin_;
  std::vector<std::uint32_t> start_{0};  ///< of the facets that are listed, and their end
  std::vector<std::uint32_t> facet_of_;  ///< of their half-edges
  std::vector<Birth> births_;
  std::size_t vertices_ = 0;
  std::size_t boundary_ = 0;  ///< half-edges without a twin
  std::uint32_t level_ = 0;
  bool alternating_ = false;  ///< made by a single step of a closed mesh: each edge has an old and a new facet
  bool regular_ = false;
};

}  // namespace hexact
