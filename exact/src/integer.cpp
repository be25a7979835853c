// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/integer.hpp"

#include "hexact/exact/rational.hpp"

#include <cctype>
#include <cstring>
#include <memory>

namespace hexact {

Integer::Integer(long long value) noexcept { mpz_init_set_si(z_, value); }

Integer::Integer(unsigned long long value) noexcept { mpz_init_set_ui(z_, value); }

Integer::Integer(__int128 value) noexcept {
  const bool negative = value < 0;
  unsigned __int128 magnitude = static_cast<unsigned __int128>(value);
  if (negative) magnitude = -magnitude;
  mpz_init_set_ui(z_, static_cast<unsigned long>(magnitude >> 64));
  mpz_mul_2exp(z_, z_, 64);
  mpz_add_ui(z_, z_, static_cast<unsigned long>(magnitude));
  if (negative) mpz_neg(z_, z_);
}

bool Integer::parse(std::string_view text, Integer& out) {
  std::string digits(text);
  const std::size_t first = !digits.empty() && digits[0] == '-' ? 1 : 0;
  if (!digits.empty() && digits[0] == '+') digits.erase(0, 1);  // mpz_set_str knows no plus sign
  if (digits.size() == first) return false;
  for (std::size_t i = first; i < digits.size(); ++i) {
    if (std::isdigit(static_cast<unsigned char>(digits[i])) == 0) return false;
  }
  return mpz_set_str(out.z_, digits.c_str(), 10) == 0;
}

Integer Integer::power_of_two(unsigned long exponent) { return Integer(1).shifted_left(exponent); }

double Integer::to_double() const { return Rational(*this).to_double(); }

std::string Integer::str() const {
  const std::unique_ptr<char, void (*)(char*)> text(mpz_get_str(nullptr, 10, z_), [](char* p) {
    void (*release)(void*, std::size_t);
    mp_get_memory_functions(nullptr, nullptr, &release);
    release(p, std::strlen(p) + 1);
  });
  return text.get();
}

Integer Integer::operator-() const {
  Integer r;
  mpz_neg(r.z_, z_);
  return r;
}

Integer Integer::shifted_left(unsigned long bits) const {
  Integer r;
  mpz_mul_2exp(r.z_, z_, bits);
  return r;
}

Integer gcd(const Integer& a, const Integer& b) {
  Integer r;
  mpz_gcd(r.raw(), a.raw(), b.raw());
  return r;
}

Integer lcm(const Integer& a, const Integer& b) {
  Integer r;
  mpz_lcm(r.raw(), a.raw(), b.raw());
  return r;
}

Integer exact_quotient(const Integer& a, const Integer& b) {
  Integer r;
  mpz_divexact(r.raw(), a.raw(), b.raw());
  return r;
}

Integer floor_quotient(const Integer& a, const Integer& b) {
  Integer r;
  mpz_fdiv_q(r.raw(), a.raw(), b.raw());
  return r;
}

Integer ceil_quotient(const Integer& a, const Integer& b) {
  Integer r;
  mpz_cdiv_q(r.raw(), a.raw(), b.raw());
  return r;
}

}  // namespace hexact
