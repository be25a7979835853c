// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/chamfer_surface.hpp"
#include "hexact/kernel/mesh_topology.hpp"
#include "located_points.hpp"

#include <array>
#include <vector>

namespace hexact::detail {

/// What a step of a chamfer surface needs to know about the level that it cuts.
struct SurfaceMap {
  explicit SurfaceMap(const ChamferSurface& surface);

  HalfEdges half_edges;
  SurfaceEdges edges;
  /// The edges at each vertex; the third is absent (kNoTwin) where only one facet is there.
  std::vector<std::array<std::uint32_t, 3>> at_vertex;
  /// Number of the new vertex where the three cuts at v meet; kNoTwin where it would be in no facet.
  std::vector<std::uint32_t> centre;
  std::size_t new_vertices = 0;
  std::vector<std::int8_t> corner_sign;  ///< of each vertex: sign of the determinant of its three normals

  [[nodiscard]] std::size_t half_edge_count() const noexcept { return half_edges.size(); }
  [[nodiscard]] bool on_boundary(std::uint32_t h) const noexcept { return half_edges.twin[h] == kNoTwin; }
  /// The edge at the origin of h that is not a side of its facet.
  [[nodiscard]] std::uint32_t third_edge(std::uint32_t h) const noexcept {
    const auto& e = at_vertex[half_edges.origin[h]];
    const std::uint32_t a = edges.edge[h], b = edges.edge[half_edges.previous[h]];
    return e[0] != a && e[0] != b ? e[0] : e[1] != a && e[1] != b ? e[1] : e[2];
  }
  /// Whether all edges at a vertex with three facets are of one sign.
  [[nodiscard]] bool is_pure(const ChamferSurface& surface, std::size_t v) const;
  [[nodiscard]] std::string edge_text(std::uint32_t e) const {
    const std::uint32_t h = edges.half_edge[e];
    return edge_name(half_edges.origin[h], half_edges.target(h));
  }
};

/// Violations of the conditions on lifts alone, and what the cut surface violates with the elements of the old level
/// whose lifts are concerned.
struct SurfaceFault {
  Finding finding;
  std::vector<std::uint32_t> edges;  ///< of the old level, whose lifts matter
};
[[nodiscard]] std::vector<SurfaceFault> lift_faults(const ChamferSurface& surface, const SurfaceMap& map, const std::vector<Integer>& lifts);

/// The next level by the formulas, nothing decided. Precondition: lift_faults is empty.
[[nodiscard]] ChamferSurface cut_edges(const ChamferSurface& surface, const SurfaceMap& map, const std::vector<Integer>& lifts);

/// Sides that do not run as predicted and facets that are not simple in the next level.
[[nodiscard]] std::vector<SurfaceFault> cut_faults(const ChamferSurface& surface, const SurfaceMap& map, const ChamferSurface& next);

/// Whether an edge runs along n_left × n_right (1) or against it (−1); 0: it has no length, or the planes no line.
/// A plane p through its origin alone tells: n_p·(target − origin) has the sign of the run times det(p, left, right).
inline int run_of_edge(const LocatedPoints<Rational>& points, std::size_t origin, std::size_t target, std::size_t left, std::size_t right) {
  for (const FacetId p : points.body().triples[origin]) {
    const int s = sign_det3(points.planes(), index(p), left, right);
    if (s != 0) return s * points.side(target, index(p));
  }
  return 0;
}

}  // namespace hexact::detail
