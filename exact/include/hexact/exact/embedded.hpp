// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/kernel/errors.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hexact {

/// Facets whose loop is no simple polygon, or runs clockwise about the normal of its plane: FacetNotSimple (facet).
/// Facets may have any shape; corners of 180° are allowed. Signs come from nearest doubles where these tell.
/// Precondition: every vertex is the one point of its planes and lies on the planes of all its facets (claim planar).
/// Throws ResourceLimit where a coordinate is beyond the finite doubles.
/// Cost: n turns for a convex facet of n corners; otherwise n log n and the pairs of edges with overlapping boxes.
/// In parallel; the result does not depend on the number of threads.
[[nodiscard]] std::vector<Finding> facet_findings(const PlaneBody& body);

/// Two facets that meet outside of their common vertices and edges, with a point where they do, in file coordinates.
struct FacetContact {
  std::size_t first = 0, second = 0;  ///< first < second
  std::string point;                  ///< "(x, y, z)" exactly
};

/// The contact with the smallest first and then smallest second facet; nullopt proves that there is none.
/// Precondition: planar, and facet_findings is empty. Works for surfaces with a boundary as well.
/// Method: a tree of boxes around facets (of correctly rounded corners: rounding is monotone, so disjoint boxes prove
/// disjoint facets); a facet all on one side of the other's plane is done; what remains is decided on the line where
/// the planes meet, with exact points. Cost: O(n log n) boxes, about 0.3 ms for each pair that has to be decided exactly.
[[nodiscard]] std::optional<FacetContact> first_facet_contact(const PlaneBody& body);

/// What keeps a body from being embedded, or nothing: an oriented manifold, with or without boundary, planar, every
/// facet a simple polygon running counter-clockwise about its normal, facets meeting in common vertices and edges
/// only, and, when it is closed, normals pointing outward (positive volume). Such a closed surface is the boundary of
/// a solid. Cost: that of first_facet_contact.
[[nodiscard]] std::string embedded_fault(const PlaneBody& body);

}  // namespace hexact
