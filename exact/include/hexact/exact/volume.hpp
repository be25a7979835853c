// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/exact/quadratic_field.hpp"
#include "hexact/kernel/facet_loops.hpp"

#include <span>

namespace hexact {

/// Exact volume of the closed surface with these points and planar loops: 1/6 Σ det(p0, pi, pi+1), phs (e.4).
/// Positive for loops counter-clockwise from outside. Summed in a balanced tree because denominators differ.
/// Cost: linear in the corners times the cost of numbers whose size is the sum of all denominators'.
[[nodiscard]] Rational exact_volume(std::span<const Point3<Rational>> points, const FacetLoops& loops);
[[nodiscard]] QuadraticField exact_volume(std::span<const Point3<QuadraticField>> points, const FacetLoops& loops);

/// Exact volume of a closed body in file coordinates, over Q or Q(√5). Throws InvalidInput (DegenerateVertex).
[[nodiscard]] QuadraticField exact_volume(const PlaneBody& body);

}  // namespace hexact
