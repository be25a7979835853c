// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/quadratic_field.hpp"

#include "hexact/kernel/errors.hpp"

#include <cmath>

namespace hexact {

QuadraticField operator*(const QuadraticField& x, const QuadraticField& y) {
  if (x.is_rational() && y.is_rational()) return {x.a_ * y.a_, Rational()};
  return {x.a_ * y.a_ + Rational(5) * x.b_ * y.b_, x.a_ * y.b_ + x.b_ * y.a_};
}

QuadraticField operator/(const QuadraticField& x, const QuadraticField& y) {
  HEXACT_EXPECTS(!y.is_zero());
  if (y.is_rational()) return {x.a_ / y.a_, x.b_ / y.a_};
  const Rational norm = y.a_ * y.a_ - Rational(5) * y.b_ * y.b_;  // not 0: √5 is irrational
  return x * QuadraticField(y.a_ / norm, -y.b_ / norm);
}

int QuadraticField::sign() const {
  const int sa = a_.sign();
  const int sb = b_.sign();
  if (sa == 0 || sa == sb) return sb == 0 ? sa : sb;
  if (sb == 0) return sa;
  const Rational difference = a_ * a_ - Rational(5) * b_ * b_;
  return difference.sign() > 0 ? sa : sb;
}

bool QuadraticField::parse(std::string_view text, QuadraticField& out) {
  constexpr std::string_view kRoot = "*sqrt5";
  const auto read = [](std::string_view t, Rational& r) {
    return t.find_first_of(".eE") == std::string_view::npos &&
           Rational::parse(t, r) == Rational::ParseResult::ok;
  };
  Rational a, b;
  if (text.size() < kRoot.size() || text.substr(text.size() - kRoot.size()) != kRoot) {
    if (!read(text, a)) return false;
    out = QuadraticField(a);
    return true;
  }
  text.remove_suffix(kRoot.size());
  const std::size_t split = text.find_last_of("+-");
  if (split == std::string_view::npos || split == 0) {
    if (!read(text, b)) return false;
  } else if (!read(text.substr(0, split), a) || !read(text.substr(split), b)) {
    return false;
  }
  out = QuadraticField(a, b);
  return true;
}

std::string QuadraticField::str() const {
  if (is_rational()) return a_.str();
  return a_.str() + (b_.sign() > 0 ? "+" : "") + b_.str() + "*sqrt5";
}

double QuadraticField::to_double() const {
  if (is_rational()) return a_.to_double();
  // √5 between two rationals of growing precision, until both ends round to the same double.
  for (unsigned long bits = 128;; bits *= 2) {
    Integer scaled = Integer(5).shifted_left(2 * bits);
    Integer root;
    mpz_sqrt(root.raw(), scaled.raw());
    const Rational low = Rational(root).scaled(-static_cast<long>(bits));
    const Rational high = Rational(root + Integer(1)).scaled(-static_cast<long>(bits));
    const double x = (a_ + b_ * low).to_double();
    const double y = (a_ + b_ * high).to_double();
    if (x == y) return x;
  }
}

}  // namespace hexact
