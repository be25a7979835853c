// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/quadratic_field.hpp"
#include "hexact/exact/rational.hpp"
#include "hexact/kernel/polygon_soup.hpp"

#include <cstddef>

namespace hexact {

/// Polygons after merging, and what was merged.
template <class S>
struct MergedSoup {
  PolygonSoup<S> soup;
  std::size_t merged_facets = 0;     ///< facets before − facets after
  std::size_t dropped_vertices = 0;  ///< vertices before − vertices after, unused ones included
};

/// Merges neighbouring facets that lie exactly in one plane and face the same way, then drops vertices that are
/// straight corners of all their facets, and vertices that no facet uses. A triangle without area joins the
/// neighbour at its longest edge. Facets that are not planar stay as they are; boundaries are allowed.
/// A merged facet stands at the place of its first part, vertices keep their order.
/// Throws InvalidInput: the findings of analyse_topology but HasBoundary and UnusedVertex; FacetWithHole,
/// PinchedFacet (facet: its first part), where a merged facet is no single loop.
/// Cost: O(H log H) operations for H corners.
template <class S>
[[nodiscard]] MergedSoup<S> merge_coplanar(const PolygonSoup<S>& soup);

extern template MergedSoup<Rational> merge_coplanar(const PolygonSoup<Rational>&);
extern template MergedSoup<QuadraticField> merge_coplanar(const PolygonSoup<QuadraticField>&);

}  // namespace hexact
