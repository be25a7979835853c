// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/rational.hpp"

#include <mpfr.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace hexact {

/// A closed interval whose ends are MPFR numbers of 384 bits. Every operation rounds outward, so the result contains
/// all exact results of numbers from the operands.
class Interval {
 public:
  static constexpr mpfr_prec_t kBits = 384;

  Interval() { init(), mpfr_set_zero(lo_, 1), mpfr_set_zero(hi_, 1); }
  Interval(int x) { init(), mpfr_set_si(lo_, x, MPFR_RNDD), mpfr_set_si(hi_, x, MPFR_RNDU); }  // NOLINT
  explicit Interval(const Rational& x) { init(), mpfr_set_q(lo_, x.raw(), MPFR_RNDD), mpfr_set_q(hi_, x.raw(), MPFR_RNDU); }
  Interval(const Rational& lo, const Rational& hi) { init(), mpfr_set_q(lo_, lo.raw(), MPFR_RNDD), mpfr_set_q(hi_, hi.raw(), MPFR_RNDU); }
  Interval(const Interval& o) { init(), mpfr_set(lo_, o.lo_, MPFR_RNDD), mpfr_set(hi_, o.hi_, MPFR_RNDU); }
  Interval(Interval&& o) noexcept { init(), mpfr_swap(lo_, o.lo_), mpfr_swap(hi_, o.hi_); }
  Interval& operator=(const Interval& o) { mpfr_set(lo_, o.lo_, MPFR_RNDD), mpfr_set(hi_, o.hi_, MPFR_RNDU); return *this; }
  Interval& operator=(Interval&& o) noexcept { mpfr_swap(lo_, o.lo_), mpfr_swap(hi_, o.hi_); return *this; }
  ~Interval() { mpfr_clear(lo_), mpfr_clear(hi_); }

  /// cos(2π a/k) and sin(2π a/k), for 2 |a| <= k.
  [[nodiscard]] static Interval cosine(int a, int k);
  [[nodiscard]] static Interval sine(int a, int k) {
    Interval r = sqrt(Interval(1) - square(cosine(a, k)));
    return a < 0 ? -r : r;
  }

  /// 1, −1, or 0 when the interval contains 0.
  [[nodiscard]] int sign() const { return mpfr_sgn(lo_) > 0 ? 1 : mpfr_sgn(hi_) < 0 ? -1 : 0; }
  [[nodiscard]] Rational lower() const { return rational(lo_); }
  [[nodiscard]] Rational upper() const { return rational(hi_); }
  /// Doubles that enclose the interval.
  [[nodiscard]] double lower_double() const { return mpfr_get_d(lo_, MPFR_RNDD); }
  [[nodiscard]] double upper_double() const { return mpfr_get_d(hi_, MPFR_RNDU); }
  /// Some point of the interval.
  [[nodiscard]] Interval middle() const {
    Interval r;
    mpfr_add(r.lo_, lo_, hi_, MPFR_RNDN);
    mpfr_div_2ui(r.lo_, r.lo_, 1, MPFR_RNDN);
    if (mpfr_cmp(r.lo_, lo_) < 0) mpfr_set(r.lo_, lo_, MPFR_RNDN);
    if (mpfr_cmp(r.lo_, hi_) > 0) mpfr_set(r.lo_, hi_, MPFR_RNDN);
    mpfr_set(r.hi_, r.lo_, MPFR_RNDN);
    return r;
  }
  /// Greatest integers at most 2^bits · lower end, and least at least 2^bits · upper end.
  [[nodiscard]] std::array<Integer, 2> scaled_ends(long bits) const {
    std::array<Integer, 2> r;
    mpfr_t t;
    mpfr_init2(t, kBits);
    mpfr_mul_2si(t, lo_, bits, MPFR_RNDD), mpfr_get_z(r[0].raw(), t, MPFR_RNDD);
    mpfr_mul_2si(t, hi_, bits, MPFR_RNDU), mpfr_get_z(r[1].raw(), t, MPFR_RNDU);
    mpfr_clear(t);
    return r;
  }

  friend Interval operator+(const Interval& a, const Interval& b) {
    Interval r;
    mpfr_add(r.lo_, a.lo_, b.lo_, MPFR_RNDD), mpfr_add(r.hi_, a.hi_, b.hi_, MPFR_RNDU);
    return r;
  }
  friend Interval operator-(const Interval& a, const Interval& b) {
    Interval r;
    mpfr_sub(r.lo_, a.lo_, b.hi_, MPFR_RNDD), mpfr_sub(r.hi_, a.hi_, b.lo_, MPFR_RNDU);
    return r;
  }
  Interval operator-() const {
    Interval r;
    mpfr_neg(r.lo_, hi_, MPFR_RNDD), mpfr_neg(r.hi_, lo_, MPFR_RNDU);
    return r;
  }
  friend Interval operator*(const Interval& a, const Interval& b);
  /// Precondition: b.sign() != 0.
  friend Interval operator/(const Interval& a, const Interval& b);
  friend Interval square(const Interval& a) {
    if (a.sign() != 0) return a * a;
    Interval r = a * a;
    mpfr_set_zero(r.lo_, 1);
    return r;
  }
  /// The root of the part of the interval that is not negative.
  friend Interval sqrt(const Interval& a) {
    Interval r;
    if (mpfr_sgn(a.lo_) > 0) mpfr_sqrt(r.lo_, a.lo_, MPFR_RNDD);
    if (mpfr_sgn(a.hi_) > 0) mpfr_sqrt(r.hi_, a.hi_, MPFR_RNDU);
    return r;
  }
  /// Precondition: sign() > 0.
  friend Interval log2(const Interval& a) {
    Interval r;
    mpfr_log2(r.lo_, a.lo_, MPFR_RNDD), mpfr_log2(r.hi_, a.hi_, MPFR_RNDU);
    return r;
  }
  Interval& operator+=(const Interval& b) {
    mpfr_add(lo_, lo_, b.lo_, MPFR_RNDD), mpfr_add(hi_, hi_, b.hi_, MPFR_RNDU);
    return *this;
  }

 private:
  void init() { mpfr_init2(lo_, kBits), mpfr_init2(hi_, kBits); }
  static Rational rational(mpfr_srcptr x) {
    Rational r;
    mpfr_get_q(r.raw(), x);
    return r;
  }
  mpfr_t lo_, hi_;
};

/// A complex number in a rectangle.
struct ComplexInterval {
  Interval re, im;
  friend ComplexInterval operator+(const ComplexInterval& a, const ComplexInterval& b) { return {a.re + b.re, a.im + b.im}; }
  friend ComplexInterval operator-(const ComplexInterval& a, const ComplexInterval& b) { return {a.re - b.re, a.im - b.im}; }
  friend ComplexInterval operator*(const ComplexInterval& a, const ComplexInterval& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
  }
  friend ComplexInterval operator*(const ComplexInterval& a, const Interval& b) { return {a.re * b, a.im * b}; }
};
inline ComplexInterval conjugate(const ComplexInterval& a) { return {a.re, -a.im}; }
/// |a|².
inline Interval norm(const ComplexInterval& a) { return square(a.re) + square(a.im); }
/// Precondition: norm(b).sign() != 0.
inline ComplexInterval operator/(const ComplexInterval& a, const ComplexInterval& b) {
  const Interval n = norm(b);
  const ComplexInterval p = a * conjugate(b);
  return {p.re / n, p.im / n};
}

}  // namespace hexact
