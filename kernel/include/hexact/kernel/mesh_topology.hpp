// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/errors.hpp"
#include "hexact/kernel/facet_loops.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace hexact {

/// What the loops of a mesh say by themselves, without coordinates. Nothing is assumed about them.
struct MeshTopology {
  std::size_t vertices = 0;         ///< as given, unused ones included
  std::size_t unused_vertices = 0;  ///< vertices in no facet
  std::size_t edges = 0;            ///< unordered pairs of consecutive corners
  std::size_t facets = 0;           ///< loops that are not empty
  std::size_t components = 0;       ///< sets of facets that are linked by common vertices
  std::size_t boundary_loops = 0;   ///< closed chains of edges with one facet; at a pinched vertex they are separate
  std::int64_t euler = 0;           ///< used vertices − edges + facets
  std::map<std::size_t, std::size_t> facet_sizes;  ///< corners -> number of facets
  std::map<std::size_t, std::size_t> valences;     ///< edges at a vertex -> number of vertices

  bool valid = false;       ///< loops have at least 3 corners, none repeated, all of them existing vertices
  bool manifold = false;    ///< valid, at most 2 facets at an edge, one fan of facets at every vertex
  bool closed = false;      ///< there are facets, and every edge has exactly 2 of them
  bool orientable = false;  ///< valid, at most 2 facets at an edge, and loops can be reversed until all edges agree
  bool oriented = false;    ///< valid, and no directed edge is used twice: the loops agree as they stand

  /// All that is wrong with the loops: WrongIndex, TooFewCorners, RepeatedCorner (facet), NotManifold (edge or
  /// vertex), NotOrientable, InconsistentOrientation (edge), HasBoundary (edge), NotConnected (facet),
  /// UnusedVertex (vertex), Empty. A count such as euler or valences is no finding.
  std::vector<Finding> findings;

  /// True for the boundary of one solid: closed, manifold, oriented and connected.
  [[nodiscard]] bool is_one_closed_surface() const noexcept {
    return closed && manifold && oriented && components == 1;
  }
};

/// Examines loops over `vertex_count` vertices. Empty loops are skipped. Cost: O(H log H) for H corners.
[[nodiscard]] MeshTopology analyse_topology(const FacetLoops& loops, std::size_t vertex_count);

/// "facet 12", "vertex 4", "edge 3-7" (smaller number first): how findings name an element.
[[nodiscard]] std::string facet_name(std::size_t facet);
[[nodiscard]] std::string vertex_name(std::size_t vertex);
[[nodiscard]] std::string edge_name(std::size_t a, std::size_t b);

/// For every half-edge (numbered facet by facet) the half-edge that runs the other way, or `kNoTwin` on a boundary.
/// Precondition: no directed edge is used twice (MeshTopology::oriented). Cost: O(H log H).
[[nodiscard]] std::vector<std::uint32_t> half_edge_twins(const FacetLoops& loops);
inline constexpr std::uint32_t kNoTwin = UINT32_MAX;

/// Loops with, for each half-edge, its facet, successor and twin: what walks around vertices need.
struct HalfEdges {
  std::vector<std::uint32_t> facet, next, previous, origin, twin;

  [[nodiscard]] std::size_t size() const noexcept { return facet.size(); }
  [[nodiscard]] std::uint32_t target(std::uint32_t h) const noexcept { return origin[next[h]]; }
  /// The half-edges that leave the origin of h, counter-clockwise from h; all of them when the vertex is not on a
  /// boundary, otherwise those from h on.
  [[nodiscard]] std::vector<std::uint32_t> around(std::uint32_t h) const;
};
/// Precondition: oriented loops.
[[nodiscard]] HalfEdges half_edges_of(const FacetLoops& loops);

}  // namespace hexact
