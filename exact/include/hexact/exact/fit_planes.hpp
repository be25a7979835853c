// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/rational.hpp"
#include "hexact/kernel/polygon_soup.hpp"

namespace hexact {

/// An exact polyhedron near a given one.
struct FittedSoup {
  PolygonSoup<Rational> soup;
  double max_displacement = 0;  ///< upper bound, rounded up, of the distance of corresponding vertices
};

/// An exactly planar, exactly convex polyhedron with the loops of one whose facets are only nearly planar.
///
/// Facets and vertices are placed one by one so that each has at most three placed neighbours (vertices of a facet,
/// facets of a vertex) before it: three determine it, with fewer it stays as near to the given corners as they
/// allow. Such an order always exists: vertex–facet incidences form a planar bipartite graph, every part of which
/// has a node of degree at most 3. Where all vertices have valence 3 it begins with all facets, each with the plane
/// of its area vector through the mean of its corners, rounded to 56 bits, and ends with all vertices; where all
/// facets are triangles the vertices stay where they are. Convexity is then decided exactly.
///
/// Throws InvalidInput: what analyse_topology finds, BadEuler, DuplicateVertices, InsideOut; FaceNotPlanar for a
/// facet without area; FaceNotStrictlyConvex, EdgeNotStrictlyConvex or VertexNotStrictlyConvex naming the witness
/// when the result is not convex. Throws ResourceLimit when numbers pass 100000 bits, as they may in large meshes
/// that are neither trivalent nor made of triangles. Cost: linear, times the cost of such numbers.
[[nodiscard]] FittedSoup fit_planes(const PolygonSoup<Rational>& soup);

}  // namespace hexact
