// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/rational.hpp"

#include "hexact/kernel/errors.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>

namespace hexact {
namespace {

using Result = Rational::ParseResult;

/// Independent of to_double: x lies within half the gap to both neighbours of d, and at a tie d is even.
bool is_nearest(const Rational& x, double d) {
  const double inf = std::numeric_limits<double>::infinity();
  const Rational below = Rational::from_double(std::nextafter(d, -inf)), above = Rational::from_double(std::nextafter(d, inf));
  const Rational here = Rational::from_double(d), half(Integer(1), Integer(2));
  const Rational low = (here + below) * half, high = (here + above) * half;
  if (x > low && x < high) return true;
  if (x != low && x != high) return false;
  // The last bit of the significand decides: d/2^e is an even integer at the unit of the last place.
  int e = 0;
  const double m = std::frexp(std::fabs(d), &e);
  const double units = std::ldexp(m, std::min(53, e + 1074));
  return std::fmod(units, 2.0) == 0;
}

TEST_CASE("rationals convert to the nearest double, ties to even, also below the normal range", "[rational]") {
  std::mt19937_64 random(1074);
  for (int i = 0; i < 3000; ++i) {
    const Integer p(static_cast<long long>(random() >> (1 + random() % 60))), q(1 + static_cast<long long>(random() >> (1 + random() % 60)));
    const long shift = static_cast<long>(random() % 2240) - 1150;
    const Rational x = Rational(i % 2 == 0 ? p : -p, q).scaled(shift);
    if (abs(x) > Rational(1).scaled(1000)) continue;
    REQUIRE(is_nearest(x, x.to_double()));
  }
  // Exact ties: odd multiples of half a unit, normal and subnormal.
  for (int i = 0; i < 500; ++i) {
    const Integer odd(static_cast<long long>((std::uint64_t{1} << 53) | (random() >> 11) | 1));
    REQUIRE(is_nearest(Rational(odd).scaled(-30), Rational(odd).scaled(-30).to_double()));
    const Rational tiny = Rational(Integer(static_cast<long long>(2 * (random() % 1000) + 1))).scaled(-1075);
    REQUIRE(is_nearest(tiny, tiny.to_double()));
  }
  CHECK(Rational(1).scaled(-1075).to_double() == 0);
  CHECK((Rational(1).scaled(-1075) + Rational(1).scaled(-3000)).to_double() == 0x1p-1074);
  CHECK(Rational(3).scaled(-1075).to_double() == 0x1p-1073);
  CHECK(std::signbit((-Rational(1).scaled(-2000)).to_double()));
}

TEST_CASE("overflow begins half a unit above the largest double", "[rational]") {
  const double largest = std::numeric_limits<double>::max();
  const Rational edge = Rational(1).scaled(1024) - Rational(1).scaled(970);  // the tie
  CHECK(edge.to_double() == std::numeric_limits<double>::infinity());
  CHECK((edge - Rational(1).scaled(-900)).to_double() == largest);
  CHECK(Rational::from_double(-largest).to_double() == -largest);
}

TEST_CASE("every double comes back from its exact value", "[rational]") {
  std::mt19937_64 random(7);
  for (int i = 0; i < 3000; ++i) {
    const std::uint64_t bits = random();
    double d = 0;
    std::memcpy(&d, &bits, sizeof d);
    if (!std::isfinite(d)) continue;
    REQUIRE(Rational::from_double(d).to_double() == d);
  }
  CHECK_THROWS_AS(Rational::from_double(std::nan("")), ContractViolation);
}

TEST_CASE("decimals are read exactly", "[rational]") {
  const auto read = [](const std::string& text) {
    Rational x;
    REQUIRE(Rational::parse(text, x) == Result::ok);
    return x.str();
  };
  CHECK(read("0.1") == "1/10");
  CHECK(read("-.5") == "-1/2");
  CHECK(read("5.") == "5");
  CHECK(read("+1.50e1") == "15");
  CHECK(read("25E-2") == "1/4");
  CHECK(read("6/4") == "3/2");
  CHECK(read("-6/4") == "-3/2");
  CHECK(read("0e999999999999999999999") == "0");
  CHECK(read("1e308").size() == 309);
  CHECK(read("000.000") == "0");
  std::mt19937_64 random(17);
  for (int i = 0; i < 1000; ++i) {
    // strtod is correctly rounded in glibc.
    std::string text = std::to_string(random());
    text.append(".").append(std::to_string(random())).append("e").append(std::to_string(static_cast<int>(random() % 560) - 340));
    Rational x;
    REQUIRE(Rational::parse(text, x) == Result::ok);
    REQUIRE(x.to_double() == std::strtod(text.c_str(), nullptr));
  }
}

TEST_CASE("texts that are no finite number are told apart", "[rational]") {
  Rational x(9);
  for (const char* bad : {"", "+", "-", ".", "e5", "1e", "1e+", "1.2.3", "1/0", "1/-2", "1/", "/2", "1 ", "0x1p3", "1,5", "--1", "+-1/2", "1e5.5", "abc"}) {
    INFO(bad);
    CHECK(Rational::parse(bad, x) == Result::malformed);
  }
  for (const char* word : {"nan", "NaN", "-nan", "inf", "-Infinity", "+INF"}) {
    INFO(word);
    CHECK(Rational::parse(word, x) == Result::not_finite);
  }
  for (const char* far : {"1e309", "-1e309", "1e999999999", "1e-999999999", "1e99999999999999999999", "1.8e308"}) {
    INFO(far);
    CHECK(Rational::parse(far, x) == Result::out_of_range);
  }
  CHECK(x == Rational(9));
}

TEST_CASE("field axioms on random values", "[rational]") {
  std::mt19937_64 random(3);
  const auto any = [&] { return Rational(Integer(static_cast<int>(random() % 41) - 20), Integer(static_cast<int>(random() % 9) + 1)); };
  for (int i = 0; i < 300; ++i) {
    const Rational a = any(), b = any(), c = any();
    CHECK(a * (b + c) == a * b + a * c);
    CHECK((a - b) + b == a);
    if (!b.is_zero()) CHECK(a / b * b == a);
    CHECK(gcd(a.numerator(), a.denominator()) == Integer(1));
    CHECK((a < b) == ((b - a).sign() > 0));
  }
  CHECK_THROWS_AS(Rational(1) / Rational(0), ContractViolation);
}

}  // namespace
}  // namespace hexact
