// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/rounding.hpp"
#include "hexact/kernel/errors.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

// Rounded numbers with bounds of their errors, for the two ways of rounding vertices.
namespace hexact::detail {

/// A double and an upper bound of its distance from the exact value.
struct Rounded {
  double value;
  double error;
};
using RoundedPoint = std::array<Rounded, 3>;

inline double upper(double x) { return std::nextafter(x, std::numeric_limits<double>::infinity()); }

inline double magnitude(const Rational& x) { return abs(x).to_double(); }
inline double magnitude(const QuadraticField& x) { return std::fabs(x.to_double()); }

inline void expect_finite(double value, FloatFormat format) {
  if (std::isfinite(value)) return;
  throw ResourceLimit(format == FloatFormat::binary32 ? "a coordinate is beyond the finite float32 numbers"
                                                      : "a coordinate is beyond the finite doubles");
}

/// A double is off from its nearest float32 by a number that is a double.
inline Rounded round_exactly(double x, FloatFormat format) {
  const double value = format == FloatFormat::binary32 ? static_cast<double>(static_cast<float>(x)) : x;
  expect_finite(value, format);
  return {value, std::fabs(x - value)};
}

/// S is Rational or QuadraticField.
template <class S>
Rounded round_exactly(const S& x, FloatFormat format) {
  double value = x.to_double();
  S off = x - S(Rational::from_double(std::isfinite(value) ? value : 0));
  if (format == FloatFormat::binary32 && std::isfinite(value)) {
    value = static_cast<double>(nearest_float(value, off.sign()));
    if (std::isfinite(value)) off = x - S(Rational::from_double(value));
  }
  expect_finite(value, format);
  return {value, off.is_zero() ? 0 : upper(magnitude(off))};
}

/// An upper bound of the length of the error, but for the rounding of its computation (see `length_bound`). Scaled by
/// the largest error, so that squares neither under- nor overflow.
inline double error_length(const RoundedPoint& p) {
  const double m = std::max({p[0].error, p[1].error, p[2].error});
  if (m == 0) return 0;
  const double x = p[0].error / m, y = p[1].error / m, z = p[2].error / m;
  return m * std::sqrt(x * x + y * y + z * z);
}
inline double length_bound(double largest) { return largest == 0 ? 0 : upper(largest * (1 + 0x1p-48)); }

/// `round(v)`, a RoundedPoint, for v < count in parallel, `grain` at a time. The result does not depend on the number of
/// threads: a maximum does not depend on the order of the reduction.
template <class Round>
RoundedVertices round_all(std::size_t count, std::size_t grain, const Round& round, const ProgressPart& progress) {
  RoundedVertices out;
  out.points.resize(count);
  using Range = tbb::blocked_range<std::size_t>;
  const double largest = tbb::parallel_reduce(
      Range(0, count, grain), 0.0,
      [&](const Range& range, double worst) {
        progress.check();
        for (std::size_t v = range.begin(); v != range.end(); ++v) {
          const RoundedPoint p = round(v);
          out.points[v] = {p[0].value, p[1].value, p[2].value};
          worst = std::max(worst, error_length(p));
        }
        return worst;
      },
      [](double a, double b) { return std::max(a, b); });
  out.max_rounding = length_bound(largest);
  return out;
}

}  // namespace hexact::detail
