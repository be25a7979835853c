// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"

#include <cstdint>

namespace hexact::detail {

/// An approximate vertex with a proven bound of its distance from the exact one. A finite bound also says that the
/// normals of its planes have a positive determinant; infinity says nothing.
struct Located {
  Point3<double> point;
  float error;
};

/// Solves for the point of three planes n·x = d by one correction of a guess (Cramer's rule on the residuals r),
/// and bounds the error by the residuals that remain: x − p = Σ rᵢ (nⱼ × nₖ) / det, whatever the lengths of the n.
/// The determinant of the normals, which the bound needs anyway, is proved positive on the way.
/// Where doubles do not suffice, 128-bit words and then big integers do; coordinates are below 2^19 in magnitude.
[[nodiscard]] Located locate(const IntegerPlanes& planes, std::uint32_t f, std::uint32_t g, std::uint32_t h, Point3<double> guess);

}  // namespace hexact::detail
