// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/quadratic_field.hpp"
#include "hexact/exact/rational.hpp"
#include "hexact/kernel/polygon_soup.hpp"

namespace hexact {

/// Two points on every edge, at the fractions t and 1 − t: an n-gon becomes a 2n-gon in its plane, and every vertex
/// that is not on a boundary a facet, planar where its valence is 3. The result is trivalent for closed meshes.
/// V' = 2E, E' = 3E, F' = F + V. Source: phs (a.3), after Claes, Beets and Van Reeth (SMI 2002).
/// Point numbers: by half-edge (facet by facet), the point near its origin; boundary edges add their far points.
/// Precondition: 0 < t < 1/2.
/// Throws InvalidInput: findings of analyse_topology but HasBoundary, UnusedVertex.
template <class S>
[[nodiscard]] PolygonSoup<S> corner_cut_mesh(const PolygonSoup<S>& soup, const Rational& t);

extern template PolygonSoup<Rational> corner_cut_mesh(const PolygonSoup<Rational>&, const Rational&);
extern template PolygonSoup<QuadraticField> corner_cut_mesh(const PolygonSoup<QuadraticField>&, const Rational&);

}  // namespace hexact
