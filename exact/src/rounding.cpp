// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/rounding.hpp"

#include "rounded_number.hpp"

namespace hexact {
namespace {

template <class S>
float exact_float(const S& x) {
  const double nearest = x.to_double();
  if (!std::isfinite(nearest)) return static_cast<float>(nearest);
  return nearest_float(nearest, (x - S(Rational::from_double(nearest))).sign());
}

template <class S>
RoundedVertices round_all(const std::vector<Point3<S>>& points, FloatFormat format, const ProgressPart& progress) {
  const auto round = [&](std::size_t v) {
    const Point3<S>& x = points[v];
    return detail::RoundedPoint{detail::round_exactly(x.x, format), detail::round_exactly(x.y, format), detail::round_exactly(x.z, format)};
  };
  return detail::round_all(points.size(), 1 << 8, round, progress);
}

/// The neighbours of x among the float32 numbers and ±2^128, as doubles; equal where x is one of them.
struct FloatNeighbours {
  double below, above;
};
FloatNeighbours float_neighbours(double x) noexcept {
  constexpr double kBeyond = 0x1p128;
  const auto finite = [](float f) { return std::isfinite(f) ? static_cast<double>(f) : std::copysign(kBeyond, static_cast<double>(f)); };
  const float f = static_cast<float>(x);
  const double at = finite(f);
  if (at == x) return {x, x};
  const float infinity = std::numeric_limits<float>::infinity();
  if (at < x) return {at, finite(std::nextafter(f, infinity))};
  return {finite(std::nextafter(f, -infinity)), at};
}

}  // namespace

bool is_float_midpoint(double x) noexcept {
  if (!(std::fabs(x) < 0x1p128)) return false;
  const auto [below, above] = float_neighbours(x);
  return below < above && x - below == above - x;  // both differences are exact in doubles
}

float nearest_float(double nearest, int side) noexcept {
  if (side == 0 || !is_float_midpoint(nearest)) return static_cast<float>(nearest);
  // One step of doubles off the midpoint is on the same side as the number.
  return static_cast<float>(std::nextafter(nearest, side * std::numeric_limits<double>::infinity()));
}
float nearest_float(const Rational& x) { return exact_float(x); }
float nearest_float(const QuadraticField& x) { return exact_float(x); }

RoundedVertices rounded_points(const std::vector<Point3<Rational>>& points, FloatFormat format, const ProgressPart& progress) {
  return round_all(points, format, progress);
}
RoundedVertices rounded_points(const std::vector<Point3<QuadraticField>>& points, FloatFormat format, const ProgressPart& progress) {
  return round_all(points, format, progress);
}

RoundedVertices rounded_points(const std::vector<Point3<double>>& points, FloatFormat format, const ProgressPart& progress) {
  return round_all(points, format, progress);
}

}  // namespace hexact
