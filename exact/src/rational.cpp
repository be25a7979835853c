// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/rational.hpp"

#include "hexact/kernel/errors.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>

namespace hexact {
namespace {

// A decimal exponent beyond this is refused before any memory is spent on it. The smallest positive
// double is about 5e-324; anything nearer to zero than 1e-100000 is taken for a mistake.
constexpr long kLargestDecimalExponent = 100000;

bool all_digits(std::string_view text) {
  return !text.empty() && std::all_of(text.begin(), text.end(), [](unsigned char c) {
    return std::isdigit(c) != 0;
  });
}

bool equals_ignoring_case(std::string_view text, std::string_view word) {
  return text.size() == word.size() &&
         std::equal(text.begin(), text.end(), word.begin(), [](unsigned char a, unsigned char b) {
           return std::tolower(a) == b;
         });
}

bool names_no_number(std::string_view text) {
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) text.remove_prefix(1);
  for (const char* word : {"nan", "inf", "infinity", "-nan", "-inf", "1.#inf", "1.#ind", "1.#qnan"}) {
    if (equals_ignoring_case(text, word)) return true;
  }
  return false;
}

Integer power_of_ten(unsigned long exponent) {
  Integer r;
  mpz_ui_pow_ui(r.raw(), 10, exponent);
  return r;
}

bool beyond_double(const Rational& x) {
  static const Rational largest = Rational::from_double(std::numeric_limits<double>::max());
  return abs(x) > largest;
}

}  // namespace

Rational::Rational(long long value) noexcept {
  mpq_init(q_);
  mpq_set_si(q_, value, 1);
}

Rational::Rational(const Integer& value) noexcept {
  mpq_init(q_);
  mpq_set_z(q_, value.raw());
}

Rational::Rational(const Integer& numerator, const Integer& denominator) {
  HEXACT_EXPECTS(!denominator.is_zero());
  mpq_init(q_);
  mpz_set(mpq_numref(q_), numerator.raw());
  mpz_set(mpq_denref(q_), denominator.raw());
  mpq_canonicalize(q_);
}

Rational Rational::from_double(double value) {
  HEXACT_EXPECTS(std::isfinite(value));
  Rational r;
  mpq_set_d(r.q_, value);
  return r;
}

Rational Rational::scaled(long exponent) const {
  Rational r;
  if (exponent >= 0) {
    mpq_mul_2exp(r.q_, q_, static_cast<unsigned long>(exponent));
  } else {
    mpq_div_2exp(r.q_, q_, static_cast<unsigned long>(-exponent));
  }
  return r;
}

Rational& Rational::operator/=(const Rational& o) {
  HEXACT_EXPECTS(!o.is_zero());
  mpq_div(q_, q_, o.q_);
  return *this;
}

Rational Rational::operator-() const {
  Rational r;
  mpq_neg(r.q_, q_);
  return r;
}

Rational::ParseResult Rational::parse(std::string_view text, Rational& out) {
  if (names_no_number(text)) return ParseResult::not_finite;
  if (const std::size_t bar = text.find('/'); bar != std::string_view::npos) {
    Integer p, q;
    if (!all_digits(text.substr(bar + 1)) || !Integer::parse(text.substr(0, bar), p) ||
        !Integer::parse(text.substr(bar + 1), q) || q.is_zero()) {
      return ParseResult::malformed;
    }
    out = Rational(p, q);
    return ParseResult::ok;
  }
  bool negative = false;
  if (!text.empty() && (text[0] == '+' || text[0] == '-')) {
    negative = text[0] == '-';
    text.remove_prefix(1);
  }
  std::string_view exponent_text;
  bool has_exponent = false;
  if (const std::size_t e = text.find_first_of("eE"); e != std::string_view::npos) {
    exponent_text = text.substr(e + 1);
    text = text.substr(0, e);
    has_exponent = true;
  }
  std::string digits;
  long point_shift = 0;
  if (const std::size_t dot = text.find('.'); dot != std::string_view::npos) {
    const std::string_view whole = text.substr(0, dot);
    const std::string_view part = text.substr(dot + 1);
    if ((whole.empty() && part.empty()) || (!whole.empty() && !all_digits(whole)) ||
        (!part.empty() && !all_digits(part))) {
      return ParseResult::malformed;
    }
    digits.assign(whole).append(part);
    point_shift = -static_cast<long>(part.size());
  } else {
    if (!all_digits(text)) return ParseResult::malformed;
    digits.assign(text);
  }
  long exponent = 0;
  bool exponent_too_long = false;
  bool exponent_negative = false;
  if (has_exponent) {
    if (!exponent_text.empty() && (exponent_text[0] == '+' || exponent_text[0] == '-')) {
      exponent_negative = exponent_text[0] == '-';
      exponent_text.remove_prefix(1);
    }
    if (!all_digits(exponent_text)) return ParseResult::malformed;
    const std::size_t significant = std::min(exponent_text.find_first_not_of('0'), exponent_text.size());
    exponent_text.remove_prefix(significant);
    exponent_too_long = exponent_text.size() > 9;
    if (!exponent_too_long && !exponent_text.empty()) {
      exponent = std::strtol(std::string(exponent_text).c_str(), nullptr, 10);
    }
    if (exponent_negative) exponent = -exponent;
  }
  Integer mantissa;
  if (!Integer::parse(digits, mantissa)) return ParseResult::malformed;
  if (mantissa.is_zero()) {
    out = Rational();
    return ParseResult::ok;
  }
  exponent += point_shift;
  if (exponent_too_long || std::labs(exponent) > kLargestDecimalExponent + static_cast<long>(digits.size())) {
    return ParseResult::out_of_range;
  }
  if (negative) mantissa = -mantissa;
  Rational value = exponent >= 0
                       ? Rational(mantissa * power_of_ten(static_cast<unsigned long>(exponent)))
                       : Rational(mantissa, power_of_ten(static_cast<unsigned long>(-exponent)));
  if ((has_exponent || point_shift != 0) && beyond_double(value)) return ParseResult::out_of_range;
  out = std::move(value);
  return ParseResult::ok;
}

double Rational::to_double() const {
  const int s = sign();
  if (s == 0) return 0.0;
  // |x| = N / D. Choose k with 2^53 <= floor(N·2^k / D) < 2^55, then round with a sticky bit.
  Integer n(mpq_numref(q_));
  const Integer d(mpq_denref(q_));
  if (s < 0) n = -n;
  const long quotient_exponent = static_cast<long>(n.bit_length()) - static_cast<long>(d.bit_length());
  if (quotient_exponent > 1025) return s * std::numeric_limits<double>::infinity();
  if (quotient_exponent < -1080) return s < 0 ? -0.0 : 0.0;
  // Subnormal results keep fewer bits: the unit of the last place is never below 2^-1074.
  const long shift = std::min<long>(54 - quotient_exponent, 1076);
  Integer numerator = shift >= 0 ? n.shifted_left(static_cast<unsigned long>(shift)) : n;
  Integer denominator = shift >= 0 ? d : d.shifted_left(static_cast<unsigned long>(-shift));
  Integer q, r;
  mpz_fdiv_qr(q.raw(), r.raw(), numerator.raw(), denominator.raw());
  const std::size_t bits = q.bit_length();
  // Bits to drop: down to 53, and down to the unit 2^-1074.
  long drop = std::max<long>(static_cast<long>(bits) - 53, shift - 1074);
  if (drop < 0) drop = 0;
  Integer kept;
  mpz_fdiv_q_2exp(kept.raw(), q.raw(), static_cast<unsigned long>(drop));
  bool round_up = false;
  if (drop > 0) {
    const bool half = mpz_tstbit(q.raw(), static_cast<unsigned long>(drop - 1)) != 0;
    const bool below = !r.is_zero() || mpz_scan1(q.raw(), 0) < static_cast<unsigned long>(drop - 1);
    round_up = half && (below || mpz_odd_p(kept.raw()) != 0);
  }
  if (round_up) kept += Integer(1);
  const double magnitude = std::ldexp(static_cast<double>(mpz_get_ui(kept.raw())), static_cast<int>(drop - shift));
  return s < 0 ? -magnitude : magnitude;
}

std::string Rational::str() const {
  const Integer q = denominator();
  return q == Integer(1) ? numerator().str() : numerator().str() + "/" + q.str();
}

}  // namespace hexact
