// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/kernel/honeycomb_map.hpp"

// Vertices of a level in floating point, with proven error bounds.
namespace hexact::detail {

/// The vertices of the level after `map`, one on each of its half-edges: where the planes of the half-edge's facet and
/// of the cuts of its two ends meet. In doubles where these give a bound below 2^-18, else in 128-bit words, else in
/// big integers. `errors` bounds |point − exact|; a finite bound also says that the normals of the three planes have a
/// positive determinant, infinity says nothing. In parallel; the result does not depend on the number of threads.
void locate_vertices(const HoneycombMap& map, const RawVector<Point3<double>>& old_points, const IntegerPlanes& planes,
                     RawVector<Point3<double>>& points, RawVector<float>& errors);

}  // namespace hexact::detail
