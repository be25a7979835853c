// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/quadratic_field.hpp"

#include "hexact/kernel/errors.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

namespace hexact {
namespace {

QuadraticField any(std::mt19937_64& random) {
  const auto r = [&] { return Rational(Integer(static_cast<int>(random() % 41) - 20), Integer(static_cast<int>(random() % 9) + 1)); };
  return {r(), r()};
}

TEST_CASE("the field Q(sqrt5) is a field", "[sqrt5]") {
  std::mt19937_64 random(5);
  CHECK(QuadraticField::sqrt5() * QuadraticField::sqrt5() == QuadraticField(5));
  for (int i = 0; i < 300; ++i) {
    const QuadraticField a = any(random), b = any(random), c = any(random);
    CHECK(a * (b + c) == a * b + a * c);
    CHECK(a * b == b * a);
    if (!b.is_zero()) CHECK(a / b * b == a);
    CHECK((a - a).is_zero());
  }
  CHECK_THROWS_AS(QuadraticField(1) / QuadraticField(0), ContractViolation);
}

TEST_CASE("signs are exact where a and b*sqrt5 almost cancel", "[sqrt5]") {
  // Convergents of √5: F/G with F² − 5G² = ±1, ±4 in turn; the differences fall below every double.
  Integer f(2), g(1);
  for (int i = 0; i < 400; ++i) {
    const QuadraticField d{Rational(f), -Rational(g)};
    const int expected = (f * f - Integer(5) * g * g).sign();
    REQUIRE(d.sign() == expected);
    REQUIRE((-d).sign() == -expected);
    const Integer next = Integer(2) * f + Integer(5) * g;
    g = f + Integer(2) * g;
    f = next;
  }
  CHECK(QuadraticField(0).sign() == 0);
  CHECK((QuadraticField::sqrt5() - QuadraticField(2)).sign() == 1);
  CHECK(QuadraticField(Rational(0), Rational(-1)).sign() == -1);
}

TEST_CASE("numbers of Q(sqrt5) convert to the nearest double", "[sqrt5]") {
  CHECK(QuadraticField::sqrt5().to_double() == std::sqrt(5.0));  // sqrt is correctly rounded
  std::mt19937_64 random(55);
  const double inf = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 500; ++i) {
    const QuadraticField x = any(random);
    const double d = x.to_double();
    const Rational here = Rational::from_double(d), half(Integer(1), Integer(2));
    const QuadraticField low = (here + Rational::from_double(std::nextafter(d, -inf))) * half;
    const QuadraticField high = (here + Rational::from_double(std::nextafter(d, inf))) * half;
    REQUIRE(low <= x);
    REQUIRE(x <= high);
  }
  // A difference of about 2^-1600: a double cannot hold it, and the loop must end.
  Integer f(2), g(1);
  for (int i = 0; i < 800; ++i) {
    const Integer next = Integer(2) * f + Integer(5) * g;
    g = f + Integer(2) * g;
    f = next;
  }
  CHECK(QuadraticField(Rational(f), -Rational(g)).to_double() == 0);
}

TEST_CASE("texts of Q(sqrt5)", "[sqrt5]") {
  std::mt19937_64 random(555);
  for (int i = 0; i < 300; ++i) {
    const QuadraticField x = any(random);
    QuadraticField y;
    REQUIRE(QuadraticField::parse(x.str(), y));
    REQUIRE(x == y);
  }
  QuadraticField x(3);
  REQUIRE(QuadraticField::parse("3/4*sqrt5", x));
  CHECK(x == QuadraticField(Rational(0), Rational(Integer(3), Integer(4))));
  REQUIRE(QuadraticField::parse("-1/2-3/4*sqrt5", x));
  CHECK(x == QuadraticField(Rational(Integer(-1), Integer(2)), Rational(Integer(-3), Integer(4))));
  for (const char* bad : {"", "sqrt5", "*sqrt5", "1+*sqrt5", "1*sqrt7", "1+2*sqrt5+1", "1/0*sqrt5", "1 +1*sqrt5", "1+-*sqrt5", "nan", "1++1*sqrt5"}) {
    INFO(bad);
    CHECK_FALSE(QuadraticField::parse(bad, x));
  }
}

}  // namespace
}  // namespace hexact
