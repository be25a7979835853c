// SPDX-License-Identifier: LGPL-3.0-or-later
// The proofs about one surface alone. Each function returns what refutes the claim, with a witness, or nothing.
#pragma once

#include "certificate_text.hpp"

#include <string>
#include <vector>

namespace check {

std::string facet_name(std::size_t f);
std::string vertex_name(std::size_t v);

// Half-edges are numbered as the corners of the surface: h starts at corner[h].
struct Edges {
  std::vector<Index> facet, next, previous, twin;
  std::vector<Index> leaving;  // of each vertex, one half-edge that starts there
};

// Connected, every edge used twice, in opposite directions, the facets at every vertex one fan. Fills `edges`.
std::string closed_fault(const Surface& surface, Edges& edges);
// Each vertex is a point, and lies on the plane of every facet around it.
std::string planar_fault(const Planes& planes, const Surface& surface);
std::string trivalent_fault(const Surface& surface);
// Closed, planar, of Euler characteristic 2, every loop turning once and every edge strictly convex. Local strict
// convexity of a closed connected surface makes it the boundary of a convex body (van Heijenoort 1952).
std::string convex_fault(const Planes& planes, const Surface& surface, Edges& edges);

}  // namespace check
