// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"

namespace hexact {

/// A body whose planes are integers of bounded size, and how far its vertices moved.
struct SnappedBody {
  PlaneBody body;
  double max_displacement = 0;  ///< upper bound, rounded up, of the distance of corresponding vertices, file units
};

/// Rounds every plane of a convex trivalent polyhedron to the nearest with all four coefficients below 2^bits, in
/// coordinates scaled (and, far from the origin, shifted) so that the polyhedron lies in [−1, 1]³. The loops stay;
/// that they still describe a convex polyhedron is decided exactly.
/// Precondition: 2 <= bits <= 4096.
/// Throws InvalidInput: the findings of examine_soup or NotTrivalent about the given polyhedron; SnappedTooCoarse
/// (naming the first edge or facet that fails) when `bits` are not enough.
[[nodiscard]] SnappedBody snap_planes(const PolygonSoup<Rational>& soup, unsigned bits);
[[nodiscard]] SnappedBody snap_planes(const PolygonSoup<QuadraticField>& soup, unsigned bits);

}  // namespace hexact
