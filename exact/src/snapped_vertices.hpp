// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>

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
                                          const Point3<double>& guess);

struct Corner {
  std::array<std::uint32_t, 3> planes;
  Point3<double> guess;
};
/// The same for many corners, four at a time; results are those of `locate_vertex`, bit for bit.
void locate_vertices(const IntegerPlanes& planes, std::span<const Corner> corners, Point3<double>* points, float* errors);

/// Locates the vertices of [begin, end), `corner_of(i)` being the corner of vertex i.
template <class CornerOf>
void locate_range(const IntegerPlanes& planes, std::size_t begin, std::size_t end, const CornerOf& corner_of,
                  RawVector<Point3<double>>& points, RawVector<float>& errors) {
  std::array<Corner, 32> block;
  while (begin < end) {
    const std::size_t count = std::min(block.size(), end - begin);
    for (std::size_t i = 0; i < count; ++i) block[i] = corner_of(static_cast<std::uint32_t>(begin + i));
    locate_vertices(planes, {block.data(), count}, &points[begin], &errors[begin]);
    begin += count;
  }
}

}  // namespace hexact::detail
