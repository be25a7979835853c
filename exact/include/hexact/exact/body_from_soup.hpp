// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/kernel/mesh_topology.hpp"
#include "hexact/kernel/polygon_soup.hpp"

#include <cstddef>
#include <optional>
#include <vector>

namespace hexact {

/// Which polygons are accepted as the boundary of a solid.
enum class SoupRule {
  planar,  ///< one closed oriented surface of exactly planar facets, of any shape
  convex,  ///< also bounding a convex polyhedron: χ = 2, facets, edges and vertices strictly convex
};

/// How the polygons lie in space, all of it decided exactly.
struct SoupShape {
  MeshTopology topology;
  bool planar = false;                    ///< every facet has an area and lies in one plane
  bool strictly_convex = false;           ///< the rule `convex` holds
  std::vector<std::size_t> bent_facets;   ///< facets that are not planar or have no area
  /// The findings of the topology, and DuplicateVertices (vertex), FaceNotPlanar, FaceNotStrictlyConvex (facet),
  /// EdgeNotStrictlyConvex (edge), VertexNotStrictlyConvex (vertex), BadEuler, InsideOut.
  std::vector<Finding> findings;
};

/// Examines polygons by the rule. Source: phs (a.1); beyond it, at vertices of valence > 3 the facets must go round
/// once: the great icosahedron has χ = 2 and passes every other test. That local strict convexity is enough for a
/// convex body is van Heijenoort's theorem (1952).
/// A closed surface with negative volume is reported as InsideOut instead of every edge of it.
/// Cost: O(H log H) operations for H corners; in integers where the coordinates have a short common denominator.
[[nodiscard]] SoupShape examine_soup(const PolygonSoup<Rational>& soup, SoupRule rule = SoupRule::convex);
[[nodiscard]] SoupShape examine_soup(const PolygonSoup<QuadraticField>& soup, SoupRule rule = SoupRule::convex);

/// The exact body of a soup: one plane per facet in facet order, with coprime integers; the loops as they are; for
/// each vertex three of its planes with independent normals, counter-clockwise from the facet with the smallest
/// number (all three when it has valence 3). Vertices of any valence are accepted.
/// The scale is 0 unless a power of two shortens the planes; no shift.
/// Throws InvalidInput with all findings of `examine_soup`; DegenerateVertex (planar rule) where all planes at a
/// vertex share a line. Cost: as examine_soup.
[[nodiscard]] PlaneBody body_from_soup(const PolygonSoup<Rational>& soup, SoupRule rule = SoupRule::convex);
[[nodiscard]] PlaneBody body_from_soup(const PolygonSoup<QuadraticField>& soup, SoupRule rule = SoupRule::convex);

/// The exact polygons of a body, in file coordinates; planes without facets are left out.
/// Precondition: the field matches. Throws InvalidInput (DegenerateVertex).
[[nodiscard]] PolygonSoup<Rational> rational_soup(const PlaneBody& body);
[[nodiscard]] PolygonSoup<QuadraticField> sqrt5_soup(const PlaneBody& body);

/// What keeps a body from the exact convex pipeline: the findings of the rule `convex`, NotTrivalent (vertex),
/// NotOnPlane (vertex: its point is not on the plane of a facet that names it), PlaneFacesInward (facet).
/// Empty when the body is a convex polyhedron with three facets at every vertex. Cost: as examine_soup.
[[nodiscard]] std::vector<Finding> convex_trivalent_findings(const PlaneBody& body);

}  // namespace hexact
