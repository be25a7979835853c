// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"

#include <cstdint>

// Vertices of a level in floating point, with proven error bounds.
namespace hexact::detail {

struct LocatedVertex {
  Point3<double> point;
  /// Bound of |point − exact|; a finite one also says that the normals have a positive determinant, infinity nothing.
  float error;
};

/// The vertex of the planes f, g, h near a guess, which is right to a part of the body's size at least. In doubles where
/// these give a bound below 2^-18, else in 128-bit words, else in big integers.
[[nodiscard]] LocatedVertex locate_vertex(const IntegerPlanes& planes, std::uint32_t f, std::uint32_t g, std::uint32_t h,
                                          Point3<double> guess);

}  // namespace hexact::detail
