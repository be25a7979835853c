// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/rational.hpp"

#include <string>
#include <string_view>

namespace hexact {

/// A number a + b·√5 of the field Q(√5), with exact sign and order.
class QuadraticField {
 public:
  QuadraticField() = default;
  QuadraticField(int value) : a_(value) {}              // NOLINT(google-explicit-constructor)
  QuadraticField(long long value) : a_(value) {}        // NOLINT(google-explicit-constructor)
  QuadraticField(Rational a) : a_(std::move(a)) {}      // NOLINT(google-explicit-constructor)
  QuadraticField(Rational a, Rational b) : a_(std::move(a)), b_(std::move(b)) {}

  [[nodiscard]] static QuadraticField sqrt5() { return {Rational(0), Rational(1)}; }
  /// Reads "p", "p/q", "p/q+r/s*sqrt5", "p-r*sqrt5" or "r/s*sqrt5", in full.
  [[nodiscard]] static bool parse(std::string_view text, QuadraticField& out);

  [[nodiscard]] const Rational& rational_part() const noexcept { return a_; }
  [[nodiscard]] const Rational& sqrt5_part() const noexcept { return b_; }
  [[nodiscard]] bool is_rational() const noexcept { return b_.is_zero(); }
  [[nodiscard]] bool is_zero() const noexcept { return a_.is_zero() && b_.is_zero(); }
  /// Exact: where a and b√5 have opposite signs, a² is compared with 5b².
  [[nodiscard]] int sign() const;
  /// Nearest double, ties to even, decided exactly.
  [[nodiscard]] double to_double() const;
  /// "p/q" or "p/q+r/s*sqrt5".
  [[nodiscard]] std::string str() const;

  [[nodiscard]] QuadraticField operator-() const { return {-a_, -b_}; }
  QuadraticField& operator+=(const QuadraticField& o) { a_ += o.a_; b_ += o.b_; return *this; }
  QuadraticField& operator-=(const QuadraticField& o) { a_ -= o.a_; b_ -= o.b_; return *this; }
  QuadraticField& operator*=(const QuadraticField& o) { return *this = *this * o; }
  friend QuadraticField operator+(const QuadraticField& x, const QuadraticField& y) { return {x.a_ + y.a_, x.b_ + y.b_}; }
  friend QuadraticField operator-(const QuadraticField& x, const QuadraticField& y) { return {x.a_ - y.a_, x.b_ - y.b_}; }
  friend QuadraticField operator*(const QuadraticField& x, const QuadraticField& y);
  /// Precondition: y != 0.
  friend QuadraticField operator/(const QuadraticField& x, const QuadraticField& y);
  friend bool operator==(const QuadraticField& x, const QuadraticField& y) noexcept { return x.a_ == y.a_ && x.b_ == y.b_; }
  friend bool operator<(const QuadraticField& x, const QuadraticField& y) { return (x - y).sign() < 0; }
  friend bool operator>(const QuadraticField& x, const QuadraticField& y) { return y < x; }
  friend bool operator<=(const QuadraticField& x, const QuadraticField& y) { return !(y < x); }
  friend bool operator>=(const QuadraticField& x, const QuadraticField& y) { return !(x < y); }

 private:
  Rational a_, b_;
};

[[nodiscard]] inline int sign(const QuadraticField& x) { return x.sign(); }

}  // namespace hexact
