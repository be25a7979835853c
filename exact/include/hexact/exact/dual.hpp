// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/quadratic_field.hpp"
#include "hexact/exact/rational.hpp"
#include "hexact/kernel/polygon_soup.hpp"

namespace hexact {

/// The dual mesh: a vertex at the mean of the corners of each facet, a facet for each vertex that is not on a
/// boundary, counter-clockwise from the facet with the smallest number. The dual of a triangle mesh is trivalent;
/// its facets are planar only by luck. Means that no facet uses are left out. Source: phs (a.3).
/// Throws InvalidInput: findings of analyse_topology but HasBoundary, UnusedVertex; NotManifold where a vertex of
/// the dual would belong to a single edge or nothing would be left (Empty).
template <class S>
[[nodiscard]] PolygonSoup<S> dual_mesh(const PolygonSoup<S>& soup);

extern template PolygonSoup<Rational> dual_mesh(const PolygonSoup<Rational>&);
extern template PolygonSoup<QuadraticField> dual_mesh(const PolygonSoup<QuadraticField>&);

}  // namespace hexact
