// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/kernel/polygon_soup.hpp"
#include "hexact/kernel/progress.hpp"

#include <vector>

namespace hexact {

/// Does x lie halfway between two neighbouring float32 numbers (2^128 standing for the one behind the largest)?
[[nodiscard]] bool is_float_midpoint(double x) noexcept;

/// The float32 nearest to a real number, ties to even, infinity beyond the finite range. `nearest` is the number's
/// nearest double and `side` the sign of number − nearest. Rounding is monotone and no double lies strictly between a
/// number and its nearest double, so the second rounding can only mislead where `nearest` is itself a midpoint.
[[nodiscard]] float nearest_float(double nearest, int side) noexcept;
/// The same, decided exactly.
[[nodiscard]] float nearest_float(const Rational& x);
[[nodiscard]] float nearest_float(const QuadraticField& x);

/// Every coordinate rounded to the nearest number of the format (ties to even), decided exactly, with a bound of the
/// distance, rounded up. Throws ResourceLimit where a coordinate is beyond the finite numbers. Cost: linear, parallel;
/// the result does not depend on the number of threads.
[[nodiscard]] RoundedVertices rounded_points(const std::vector<Point3<Rational>>& points, FloatFormat format,
                                             const ProgressPart& progress = {});
[[nodiscard]] RoundedVertices rounded_points(const std::vector<Point3<QuadraticField>>& points, FloatFormat format,
                                             const ProgressPart& progress = {});
[[nodiscard]] RoundedVertices rounded_points(const std::vector<Point3<double>>& points, FloatFormat format,
                                             const ProgressPart& progress = {});

}  // namespace hexact
