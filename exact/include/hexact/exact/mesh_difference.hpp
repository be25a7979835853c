// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/kernel/polygon_soup.hpp"

#include <string>

namespace hexact {

/// What keeps the mesh from being the correct rounding of the body: every coordinate the double nearest to the exact
/// one (ties to even), or the float32 nearest to it where the mesh says that its file holds float32, and the same
/// loops. A mesh of a format with triangles only has the triangles of the fans from the first corners of the loops, in
/// order, compared by their coordinates. Empty when it is; otherwise facet or vertex with both numbers. Cost: linear.
[[nodiscard]] std::string mesh_difference(const PlaneBody& body, const PolygonSoup<Rational>& mesh);

}  // namespace hexact
