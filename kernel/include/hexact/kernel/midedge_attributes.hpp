// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/mesh_attributes.hpp"
#include "hexact/kernel/midedge.hpp"

namespace hexact {

/// The attributes of the level `after` from those of the level `before`, one single or double step earlier.
///
/// Names: an old facet keeps its name; a facet that cuts off a vertex or an edge takes the name of the facet with the
/// smallest number there.
///
/// Texture coordinates are refined by the rule of the points, over facets and vertices that go on smoothly; an edge on a
/// seam, like one on the boundary, gives its middle on either side. A facet that cuts off a vertex on a seam lies in the
/// piece of the facet with the smallest number there: its corners on edges of that piece have their places in it, all
/// others the place of the vertex. Likewise the quadrilateral that a double step makes of an edge on a seam: its corners
/// beyond the seam are a quarter of the edge away from the ends. Where that facet has no coordinates, neither has the new one.
template <class S>
[[nodiscard]] MeshAttributes<S> refined_attributes(const MidedgeMap& before, const MidedgeMap& after,
                                                   const MeshAttributes<S>& attributes, MidedgeRule rule);

/// Gives equal texture coordinates the same position, so that only real seams are left. Cost: O(n log n).
template <class S>
[[nodiscard]] CornerValues<S> welded(const CornerValues<S>& corners);

extern template MeshAttributes<double> refined_attributes(const MidedgeMap&, const MidedgeMap&, const MeshAttributes<double>&, MidedgeRule);
extern template CornerValues<double> welded(const CornerValues<double>&);

}  // namespace hexact
