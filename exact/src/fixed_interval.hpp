// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/rational.hpp"
#include "hexact/kernel/errors.hpp"

#include <algorithm>
#include <array>

namespace hexact::detail {

/// All reals from low · 2^-kBits to high · 2^-kBits. Every operation encloses all its exact results.
struct FixedInterval {
  static constexpr unsigned long kBits = 320;
  Integer low, high;

  FixedInterval() = default;
  FixedInterval(int value) : low(Integer(value).shifted_left(kBits)), high(low) {}  // NOLINT(google-explicit-constructor)
  FixedInterval(Integer l, Integer h) : low(std::move(l)), high(std::move(h)) {}
  explicit FixedInterval(const Rational& x)
      : low(floor_quotient(x.numerator().shifted_left(kBits), x.denominator())),
        high(ceil_quotient(x.numerator().shifted_left(kBits), x.denominator())) {}

  /// −1 or 1 where all numbers in the interval have that sign, else 0.
  [[nodiscard]] int certain_sign() const { return low.sign() > 0 ? 1 : high.sign() < 0 ? -1 : 0; }
  [[nodiscard]] Rational middle() const { return Rational(low + high).scaled(-static_cast<long>(kBits) - 1); }
  /// Half the width.
  [[nodiscard]] Rational radius() const { return Rational(high - low).scaled(-static_cast<long>(kBits) - 1); }

  friend FixedInterval operator+(const FixedInterval& a, const FixedInterval& b) { return {a.low + b.low, a.high + b.high}; }
  friend FixedInterval operator-(const FixedInterval& a, const FixedInterval& b) { return {a.low - b.high, a.high - b.low}; }
  friend FixedInterval operator-(const FixedInterval& a) { return {-a.high, -a.low}; }
  friend FixedInterval operator*(const FixedInterval& a, const FixedInterval& b) {
    const std::array<Integer, 4> p{a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high};
    const auto [least, most] = std::minmax_element(p.begin(), p.end());
    const Integer unit = Integer::power_of_two(kBits);
    return {floor_quotient(*least, unit), ceil_quotient(*most, unit)};
  }
  /// Precondition: `b` has a certain sign.
  friend FixedInterval operator/(const FixedInterval& a, const FixedInterval& b) {
    HEXACT_EXPECTS(b.certain_sign() != 0);
    FixedInterval r;
    bool first = true;
    for (const Integer* x : {&a.low, &a.high}) {
      for (const Integer* y : {&b.low, &b.high}) {
        const Integer scaled = x->shifted_left(kBits);
        const Integer l = floor_quotient(scaled, *y), h = ceil_quotient(scaled, *y);
        if (first || l < r.low) r.low = l;
        if (first || h > r.high) r.high = h;
        first = false;
      }
    }
    return r;
  }
};

/// A complex number over T.
template <class T>
struct Complex {
  T re, im;
  friend Complex operator+(const Complex& a, const Complex& b) { return {a.re + b.re, a.im + b.im}; }
  friend Complex operator-(const Complex& a, const Complex& b) { return {a.re - b.re, a.im - b.im}; }
  friend Complex operator*(const Complex& a, const Complex& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  /// Precondition: |b|² is certainly positive.
  friend Complex operator/(const Complex& a, const Complex& b) {
    const T norm = b.re * b.re + b.im * b.im;
    return {(a.re * b.re + a.im * b.im) / norm, (a.im * b.re - a.re * b.im) / norm};
  }
};

}  // namespace hexact::detail
