// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/quadratic_field.hpp"
#include "hexact/exact/rational.hpp"
#include "hexact/kernel/polygon_soup.hpp"

namespace hexact {

/// Cuts every facet into triangles with its own corners: exactly planar ones by cutting off ears, decided by exact
/// signs, so that also reflex corners keep the region; bent ones by a fan from their first corner. Strictly convex
/// facets become fans from their first corner. Triangles of a facet follow each other.
/// Throws InvalidInput: TooFewCorners, WrongIndex, RepeatedCorner; NotSimple (facet) where the outline of a planar
/// facet crosses itself. Cost: O(n) sign tests for a strictly convex n-gon, O(n³) at worst.
template <class S>
[[nodiscard]] PolygonSoup<S> triangulate(const PolygonSoup<S>& soup);

extern template PolygonSoup<Rational> triangulate(const PolygonSoup<Rational>&);
extern template PolygonSoup<QuadraticField> triangulate(const PolygonSoup<QuadraticField>&);

}  // namespace hexact
