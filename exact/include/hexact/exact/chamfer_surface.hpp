// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/kernel/errors.hpp"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace hexact {

// The exact chamfer on surfaces that need not be convex: planar facets of any shape, three planes at every vertex, any
// genus, with or without boundary. As on convex solids the edge between F and G gets the plane F + G − τ·(0, 0, 0, 1),
// planes being scaled to normals of nearly equal length and doubled for the next level; τ > 0 where the edge is convex,
// τ < 0 where it is concave and the new facet fills the groove. docs/chamfer-nonconvex.md has the conditions and proofs.

/// One level. Half-edges are numbered facet by facet, as the corners of the loops.
struct ChamferSurface {
  /// Scaled planes in the frame of the input. Planes without a facet are those that it had, and the cuts of boundary edges.
  PlaneBody body;
  std::vector<std::uint32_t> right;  ///< plane on the right of each half-edge: of the facet there, or beyond the boundary
  std::vector<std::int8_t> sign;     ///< of each half-edge: 1 convex (it runs along n_left × n_right), −1 concave
  std::uint32_t level = 0;
};

/// The numbers that half-edges are given by the edges they lie on, as chamfers order them: by the half-edge that runs
/// from the smaller to the larger vertex, or has a boundary on its right.
struct SurfaceEdges {
  std::vector<std::uint32_t> edge;       ///< of each half-edge
  std::vector<std::uint32_t> half_edge;  ///< that half-edge of each edge
};
[[nodiscard]] SurfaceEdges number_surface_edges(const ChamferSurface& surface);

/// Level 0. Planes are multiplied by integers so that all normals are equally long to 2^-12.
/// Throws InvalidInput with all findings: FieldNotRational; those of the topology (a boundary is accepted);
/// NotTrivalent, DegenerateVertex (vertex: its three planes have dependent normals, as at coplanar facets); NotOnPlane
/// (vertex); FacetNotSimple (facet); EdgeFlat (edge: its planes are parallel), BoundaryPlane (edge: its ends do not share
/// one plane beside that of the facet); VertexNotEmbedded (vertex: its facets pass through each other).
/// Cost: linear for convex facets, see facet_findings.
[[nodiscard]] ChamferSurface chamfer_surface_start(const PlaneBody& body);

/// One step with given lifts, one integer for each edge in the scale of the planes of `surface`. Decides exactly, and
/// throws InvalidInput with what fails:
///   BadLifts (wrong count), LiftSign (edge: not positive where convex, negative where concave);
///   TriangleInequality (vertex, all edges of one sign: a lift is not smaller than the sum of the others in magnitude);
///   SpokeCollapse (vertex, edges of both signs: a lift equals the sum of the two others in magnitude);
///   SideReversed (edge, in a facet), FacetNotSimple (facet of the new level).
/// Cost: linear, about 40 µs for each facet.
[[nodiscard]] ChamferSurface chamfer_surface_step(const ChamferSurface& surface, const std::vector<Integer>& lifts);

/// One step with lifts by rule: a fifth of the shortest edge beside times the sine of the angle, lowered until each is
/// at most 0.9 of the sum of the other two at either end; halved around what the exact decision refuses, which ends
/// because equal small lifts are accepted. Lifts are rounded to 14 bits; planes are widened where they have fewer.
/// Floating point proposes, the step decides. Throws NumericalFailure should 60 rounds not be enough.
[[nodiscard]] ChamferSurface chamfer_surface_step(const ChamferSurface& surface);

/// Number of concave edges, boundary edges counted once.
[[nodiscard]] std::size_t concave_edge_count(const ChamferSurface& surface);

}  // namespace hexact
