// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/quadratic_field.hpp"

#include <cmath>
#include <optional>

// Fixed-point intervals with a middle and a radius.
namespace hexact::detail {

/// All reals within radius · 2^-bits of middle · 2^-bits; `bits` is the same for all operands of an operation.
struct FixedBall {
  Integer middle;
  long double radius = 0;  ///< units of the last place, an upper bound; its exponents reach 2^16383
};

/// Each bound below is a sum of few products of non-negative doubles, off by less than 2^-48 of itself.
inline long double rounded_up(long double bound) { return bound * (1 + 0x1p-48L); }
/// |x|, truncated to a double's precision.
inline long double truncated_magnitude(const Integer& x) {
  long exponent = 0;
  const double mantissa = mpz_get_d_2exp(&exponent, x.raw());
  return std::ldexp(static_cast<long double>(std::fabs(mantissa)), static_cast<int>(exponent));
}
/// |middle| in units, rounded up.
inline long double magnitude_in_units(const Integer& x) { return truncated_magnitude(x) * (1 + 0x1p-50L); }

inline FixedBall operator+(const FixedBall& x, const FixedBall& y) {
  return {x.middle + y.middle, rounded_up(x.radius + y.radius)};
}
inline FixedBall operator-(const FixedBall& x, const FixedBall& y) {
  return {x.middle - y.middle, rounded_up(x.radius + y.radius)};
}

inline FixedBall product(const FixedBall& x, const FixedBall& y, unsigned long bits) {
  FixedBall out{x.middle * y.middle, 0};
  mpz_fdiv_q_2exp(out.middle.raw(), out.middle.raw(), bits);
  const long double spread = magnitude_in_units(x.middle) * y.radius + magnitude_in_units(y.middle) * x.radius + x.radius * y.radius;
  out.radius = rounded_up(std::ldexp(spread, -static_cast<int>(bits)) + 1);
  return out;
}

/// Empty where the divisor may be zero. With q = m/n: |x/y − q| <= (r_x + |q|·r_y)/(|n| − r_y).
inline std::optional<FixedBall> quotient(const FixedBall& x, const FixedBall& y, unsigned long bits) {
  const long double least = truncated_magnitude(y.middle) * (1 - 0x1p-50L) - y.radius * (1 + 0x1p-50L);
  if (!(least > 0)) return std::nullopt;
  FixedBall out{floor_quotient(x.middle.shifted_left(bits), y.middle), 0};
  const long double share = x.radius + std::ldexp(magnitude_in_units(out.middle) + 1, -static_cast<int>(bits)) * y.radius;
  out.radius = rounded_up(std::ldexp(share / least, static_cast<int>(bits)) + 1);
  return out;
}

/// An enclosure of a number.
inline FixedBall enclosure(const Rational& x, unsigned long bits) {
  return {floor_quotient(x.numerator().shifted_left(bits), x.denominator()), 1};
}
/// √5 lies within 2^-k of its approximation by k binary digits.
inline FixedBall enclosure(const QuadraticField& x, unsigned long bits) {
  if (x.is_rational()) return enclosure(x.rational_part(), bits);
  const Integer magnitude = floor_quotient(abs(x.sqrt5_part()).numerator(), x.sqrt5_part().denominator());
  const unsigned long digits = bits + magnitude.bit_length() + 1;
  Integer root;
  mpz_sqrt(root.raw(), Integer(5).shifted_left(2 * digits).raw());
  FixedBall out = enclosure(x.rational_part() + x.sqrt5_part() * Rational(root).scaled(-static_cast<long>(digits)), bits);
  out.radius += 1;
  return out;
}

}  // namespace hexact::detail
