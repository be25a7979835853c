// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/quadratic_field.hpp"
#include "hexact/exact/rational.hpp"
#include "hexact/kernel/polygon_soup.hpp"

#include <cstddef>

namespace hexact {

template <class S>
struct TruncatedSoup {
  PolygonSoup<S> soup;
  std::size_t truncated_vertices = 0;
};

/// Cuts every vertex of valence ≠ 3 of a convex polyhedron by one plane, so that three facets meet everywhere.
/// The plane at v has as normal the sum of the facet normals at v and passes, along it, the fraction θ of the way
/// to the nearest neighbour. All planes come from the given polyhedron, so the order does not matter.
/// Old facets keep their places, the new ones follow in the order of their vertices; vertices that stay keep their
/// order, the new ones follow, counter-clockwise around each cut vertex. Source: phs (a.1).
/// Precondition: 0 < θ < 1/2 (below 1/2 neighbouring cuts stay apart).
/// Throws InvalidInput with the findings of examine_soup when the polyhedron is not strictly convex.
template <class S>
[[nodiscard]] TruncatedSoup<S> truncate_vertices(const PolygonSoup<S>& soup, const Rational& theta);

extern template TruncatedSoup<Rational> truncate_vertices(const PolygonSoup<Rational>&, const Rational&);
extern template TruncatedSoup<QuadraticField> truncate_vertices(const PolygonSoup<QuadraticField>&, const Rational&);

}  // namespace hexact
