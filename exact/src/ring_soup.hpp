// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"

#include <algorithm>
#include <optional>
#include <vector>

// Rational points on a common integer grid, where one is short enough: signs then cost integer products only.
namespace hexact::detail {

/// point · denominator = integer point.
struct IntegerPoints {
  std::vector<Point3<Integer>> points;
  Integer denominator;
};

/// Empty when the least common denominator has more than `max_bits` bits: then the points are unrelated fractions.
inline std::optional<IntegerPoints> integer_points(const std::vector<Point3<Rational>>& points,
                                                   std::size_t max_bits = 4096) {
  IntegerPoints grid;
  grid.denominator = Integer(1);
  for (const auto& p : points) {
    for (const Rational* x : {&p.x, &p.y, &p.z}) {
      if (mpz_divisible_p(grid.denominator.raw(), mpq_denref(x->raw())) != 0) continue;
      grid.denominator = lcm(grid.denominator, x->denominator());
      if (grid.denominator.bit_length() > max_bits) return std::nullopt;
    }
  }
  const auto scaled = [&](const Rational& x) {
    return x.numerator() * exact_quotient(grid.denominator, x.denominator());
  };
  grid.points.reserve(points.size());
  for (const auto& p : points) grid.points.push_back({scaled(p.x), scaled(p.y), scaled(p.z)});
  return grid;
}

/// Calls `use(points)` with the points on an integer grid (multiplied by a common denominator) or as they are.
template <class Use>
auto on_short_ring(const std::vector<Point3<Rational>>& points, Use&& use) {
  if (const std::optional<IntegerPoints> grid = integer_points(points)) return use(grid->points);
  return use(points);
}
template <class Use>
auto on_short_ring(const std::vector<Point3<QuadraticField>>& points, Use&& use) {
  return use(points);
}

}  // namespace hexact::detail
