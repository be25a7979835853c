// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/integer.hpp"

#include <gmp.h>

#include <compare>
#include <string>
#include <string_view>

namespace hexact {

/// A rational number in lowest terms, denominator > 0. A plain value without expression templates.
class Rational {
 public:
  Rational() noexcept { mpq_init(q_); }
  Rational(long long value) noexcept;  // NOLINT(google-explicit-constructor): integers embed exactly
  Rational(int value) noexcept : Rational(static_cast<long long>(value)) {}   // NOLINT
  Rational(long value) noexcept : Rational(static_cast<long long>(value)) {}  // NOLINT
  Rational(const Integer& value) noexcept;                                    // NOLINT
  /// numerator / denominator in lowest terms. Precondition: denominator != 0.
  Rational(const Integer& numerator, const Integer& denominator);
  Rational(const Rational& other) noexcept {
    mpq_init(q_);
    mpq_set(q_, other.q_);
  }
  Rational(Rational&& other) noexcept {
    mpq_init(q_);
    mpq_swap(q_, other.q_);
  }
  Rational& operator=(const Rational& other) noexcept {
    mpq_set(q_, other.q_);
    return *this;
  }
  Rational& operator=(Rational&& other) noexcept {
    mpq_swap(q_, other.q_);
    return *this;
  }
  ~Rational() { mpq_clear(q_); }

  /// The exact value of a finite double. Precondition: value is finite.
  [[nodiscard]] static Rational from_double(double value);
  /// value · 2^exponent, exponent of either sign.
  [[nodiscard]] Rational scaled(long exponent) const;

  /// What a text could not be read as a number for.
  enum class ParseResult { ok, malformed, not_finite, out_of_range };
  /// Reads "p", "p/q" (q > 0 digits) or a decimal with optional exponent, in full and exactly. A decimal whose
  /// magnitude is beyond the largest finite double, or whose exponent is beyond ±100000, is out_of_range before
  /// any memory is spent; the words nan and inf are not_finite. Integers of any length are accepted for p and q.
  [[nodiscard]] static ParseResult parse(std::string_view text, Rational& out);

  [[nodiscard]] int sign() const noexcept { return mpq_sgn(q_); }
  [[nodiscard]] bool is_zero() const noexcept { return mpq_sgn(q_) == 0; }
  [[nodiscard]] Integer numerator() const { return Integer(mpq_numref(q_)); }
  [[nodiscard]] Integer denominator() const { return Integer(mpq_denref(q_)); }
  /// Nearest double, ties to even, gradual underflow; ±infinity beyond the finite range. Exact decision.
  [[nodiscard]] double to_double() const;
  /// "p" or "p/q".
  [[nodiscard]] std::string str() const;
  [[nodiscard]] mpq_srcptr raw() const noexcept { return q_; }
  [[nodiscard]] mpq_ptr raw() noexcept { return q_; }

  [[nodiscard]] Rational operator-() const;
  Rational& operator+=(const Rational& o) noexcept { mpq_add(q_, q_, o.q_); return *this; }
  Rational& operator-=(const Rational& o) noexcept { mpq_sub(q_, q_, o.q_); return *this; }
  Rational& operator*=(const Rational& o) noexcept { mpq_mul(q_, q_, o.q_); return *this; }
  /// Precondition: o != 0.
  Rational& operator/=(const Rational& o);
  friend Rational operator+(const Rational& a, const Rational& b) { Rational r; mpq_add(r.q_, a.q_, b.q_); return r; }
  friend Rational operator-(const Rational& a, const Rational& b) { Rational r; mpq_sub(r.q_, a.q_, b.q_); return r; }
  friend Rational operator*(const Rational& a, const Rational& b) { Rational r; mpq_mul(r.q_, a.q_, b.q_); return r; }
  friend Rational operator/(const Rational& a, const Rational& b) { Rational r(a); r /= b; return r; }
  friend bool operator==(const Rational& a, const Rational& b) noexcept { return mpq_equal(a.q_, b.q_) != 0; }
  friend std::strong_ordering operator<=>(const Rational& a, const Rational& b) noexcept {
    return mpq_cmp(a.q_, b.q_) <=> 0;
  }

 private:
  mpq_t q_;
};

[[nodiscard]] inline int sign(const Rational& x) noexcept { return x.sign(); }
[[nodiscard]] inline Rational abs(const Rational& x) { return x.sign() < 0 ? -x : x; }

}  // namespace hexact
