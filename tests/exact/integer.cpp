// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/integer.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <random>

namespace hexact {
namespace {

TEST_CASE("integers read in full or not at all", "[integer]") {
  Integer x(7);
  for (const char* bad : {"", "+", "-", "+-1", "--1", "1 ", " 1", "1.0", "0x10", "1e3", "1_000", "١"}) {
    INFO(bad);
    CHECK_FALSE(Integer::parse(bad, x));
    CHECK(x == Integer(7));
  }
  REQUIRE(Integer::parse("+0012", x));
  CHECK(x == Integer(12));
  REQUIRE(Integer::parse("-0", x));
  CHECK(x.is_zero());
  std::string digits(501, '9');
  digits[0] = '-';
  REQUIRE(Integer::parse(digits, x));
  CHECK(x.str() == digits);
}

TEST_CASE("conversions of machine words", "[integer]") {
  const __int128 low = static_cast<__int128>(1) << 127;  // wraps to the least value
  CHECK(Integer(low).str() == "-170141183460469231731687303715884105728");
  CHECK(Integer(~low).str() == "170141183460469231731687303715884105727");
  CHECK(Integer(std::numeric_limits<long long>::min()).str() == "-9223372036854775808");
  CHECK(Integer(std::numeric_limits<unsigned long long>::max()).str() == "18446744073709551615");
  CHECK(Integer(std::numeric_limits<long long>::min()).fits_int64());
  CHECK_FALSE(Integer(std::numeric_limits<unsigned long long>::max()).fits_int64());
  CHECK(Integer(-5).bit_length() == 3);
  CHECK(Integer(0).bit_length() == 0);
  CHECK(Integer::power_of_two(100).bit_length() == 101);
}

TEST_CASE("quotients round towards the side they name", "[integer]") {
  for (int a = -12; a <= 12; ++a) {
    for (int b = -5; b <= 5; ++b) {
      if (b == 0) continue;
      const Integer low = floor_quotient(Integer(a), Integer(b)), high = ceil_quotient(Integer(a), Integer(b));
      CHECK(low.to_int64() == static_cast<long>(std::floor(static_cast<double>(a) / b)));
      CHECK(high.to_int64() == static_cast<long>(std::ceil(static_cast<double>(a) / b)));
      CHECK(exact_quotient(Integer(a) * Integer(b), Integer(b)) == Integer(a));
    }
  }
  CHECK(gcd(Integer(0), Integer(0)).is_zero());
  CHECK(gcd(Integer(-12), Integer(18)) == Integer(6));
  CHECK(lcm(Integer(-4), Integer(6)) == Integer(12));
}

TEST_CASE("integers convert to the nearest double", "[integer]") {
  // The compiler's conversion of 64-bit words is correctly rounded.
  std::mt19937_64 random(64);
  for (int i = 0; i < 2000; ++i) {
    const auto x = static_cast<long long>(random() >> (random() % 60));
    REQUIRE(Integer(x).to_double() == static_cast<double>(x));
    REQUIRE(Integer(-x).to_double() == static_cast<double>(-x));
  }
  CHECK(Integer::power_of_two(1024).to_double() == std::numeric_limits<double>::infinity());
  CHECK((-Integer::power_of_two(1024)).to_double() == -std::numeric_limits<double>::infinity());
  CHECK(Integer::power_of_two(1023).to_double() == 0x1p1023);
}

}  // namespace
}  // namespace hexact
