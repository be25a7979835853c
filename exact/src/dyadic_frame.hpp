// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "facet_geometry.hpp"

#include <algorithm>

namespace hexact::detail {

/// Coordinates in which points lie in [−1, 1]³: file = 2^scale · here + shift.
struct DyadicFrame {
  long scale = 0;
  std::array<Rational, 3> shift{};

  [[nodiscard]] Point3<Rational> here(const Point3<Rational>& p) const {
    return {(p.x - shift[0]).scaled(-scale), (p.y - shift[1]).scaled(-scale), (p.z - shift[2]).scaled(-scale)};
  }
  [[nodiscard]] Point3<Rational> file(const Point3<Rational>& p) const {
    return {p.x.scaled(scale) + shift[0], p.y.scaled(scale) + shift[1], p.z.scaled(scale) + shift[2]};
  }
};

/// The nearest integer, halves up.
inline Integer nearest_integer(const Rational& x) {
  const Integer two(2);
  return floor_quotient(two * x.numerator() + x.denominator(), two * x.denominator());
}

/// Least e with |x| <= 2^e; 0 for 0.
inline long ceil_log2(const Rational& x) {
  if (x.is_zero()) return 0;
  long e = static_cast<long>(x.numerator().bit_length()) - static_cast<long>(x.denominator().bit_length());
  while (Rational(1).scaled(e) < abs(x)) ++e;
  while (!(Rational(1).scaled(e - 1) < abs(x))) --e;
  return e;
}

/// The frame of points: a shift only where they are farther from the origin than they are apart, and then a multiple
/// of 2^(scale − 4).
inline DyadicFrame frame_of(const std::vector<Point3<Rational>>& points) {
  DyadicFrame frame;
  std::array<Rational, 3> centre;
  Rational half_extent(0), farthest(0);
  for (int axis = 0; axis < 3; ++axis) {
    Rational low = coordinate(points[0], axis), high = low;
    for (const auto& p : points) {
      const Rational& x = coordinate(p, axis);
      if (x < low) low = x;
      if (x > high) high = x;
    }
    centre[static_cast<std::size_t>(axis)] = (low + high).scaled(-1);
    half_extent = std::max(half_extent, (high - low).scaled(-1));
    farthest = std::max({farthest, abs(low), abs(high)});
  }
  const long extent_exponent = ceil_log2(half_extent);
  if (farthest <= Rational(1).scaled(extent_exponent + 1)) {
    frame.scale = ceil_log2(farthest);
    return frame;
  }
  frame.scale = extent_exponent + 1;  // room for the rounding of the centre
  for (std::size_t axis = 0; axis < 3; ++axis) {
    frame.shift[axis] = Rational(nearest_integer(centre[axis].scaled(4 - frame.scale))).scaled(frame.scale - 4);
  }
  return frame;
}

/// A vector along `n` with integer entries of magnitude at most 2^bits, the largest exactly 2^bits.
inline Point3<Integer> rounded_direction(const Point3<Rational>& n, unsigned bits) {
  const Rational largest = std::max({abs(n.x), abs(n.y), abs(n.z)});
  const auto rounded = [&](const Rational& x) {
    return nearest_integer((x / largest).scaled(static_cast<long>(bits)));
  };
  return {rounded(n.x), rounded(n.y), rounded(n.z)};
}

}  // namespace hexact::detail
