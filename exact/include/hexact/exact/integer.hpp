// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <gmp.h>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace hexact {

/// An integer of any size. A plain value: every operation returns a new number, there are no
/// expression templates, and `auto` is safe.
class Integer {
 public:
  Integer() noexcept { mpz_init(z_); }
  Integer(long long value) noexcept;  // NOLINT(google-explicit-constructor): integers embed exactly
  Integer(int value) noexcept : Integer(static_cast<long long>(value)) {}   // NOLINT
  Integer(long value) noexcept : Integer(static_cast<long long>(value)) {}  // NOLINT
  explicit Integer(unsigned long long value) noexcept;
  explicit Integer(__int128 value) noexcept;
  /// Takes over the value of a GMP integer by copying it.
  explicit Integer(mpz_srcptr value) noexcept { mpz_init_set(z_, value); }
  Integer(const Integer& other) noexcept { mpz_init_set(z_, other.z_); }
  Integer(Integer&& other) noexcept {
    mpz_init(z_);
    mpz_swap(z_, other.z_);
  }
  Integer& operator=(const Integer& other) noexcept {
    mpz_set(z_, other.z_);
    return *this;
  }
  Integer& operator=(Integer&& other) noexcept {
    mpz_swap(z_, other.z_);
    return *this;
  }
  ~Integer() { mpz_clear(z_); }

  /// Reads [+-]?[0-9]+ in full; returns false and leaves `out` alone otherwise.
  [[nodiscard]] static bool parse(std::string_view text, Integer& out);
  /// 2^exponent.
  [[nodiscard]] static Integer power_of_two(unsigned long exponent);

  [[nodiscard]] int sign() const noexcept { return mpz_sgn(z_); }
  [[nodiscard]] bool is_zero() const noexcept { return mpz_sgn(z_) == 0; }
  /// Number of bits of |x|; 0 for 0.
  [[nodiscard]] std::size_t bit_length() const noexcept {
    return is_zero() ? 0 : mpz_sizeinbase(z_, 2);
  }
  [[nodiscard]] bool fits_int64() const noexcept { return mpz_fits_slong_p(z_) != 0; }
  /// Precondition: fits_int64().
  [[nodiscard]] std::int64_t to_int64() const noexcept { return mpz_get_si(z_); }
  /// Nearest double, ties to even; ±infinity when too large.
  [[nodiscard]] double to_double() const;
  [[nodiscard]] std::string str() const;
  [[nodiscard]] mpz_srcptr raw() const noexcept { return z_; }
  [[nodiscard]] mpz_ptr raw() noexcept { return z_; }

  [[nodiscard]] Integer operator-() const;
  [[nodiscard]] Integer shifted_left(unsigned long bits) const;
  Integer& operator+=(const Integer& o) noexcept { mpz_add(z_, z_, o.z_); return *this; }
  Integer& operator-=(const Integer& o) noexcept { mpz_sub(z_, z_, o.z_); return *this; }
  Integer& operator*=(const Integer& o) noexcept { mpz_mul(z_, z_, o.z_); return *this; }
  friend Integer operator+(const Integer& a, const Integer& b) { Integer r; mpz_add(r.z_, a.z_, b.z_); return r; }
  friend Integer operator-(const Integer& a, const Integer& b) { Integer r; mpz_sub(r.z_, a.z_, b.z_); return r; }
  friend Integer operator*(const Integer& a, const Integer& b) { Integer r; mpz_mul(r.z_, a.z_, b.z_); return r; }
  friend bool operator==(const Integer& a, const Integer& b) noexcept { return mpz_cmp(a.z_, b.z_) == 0; }
  friend std::strong_ordering operator<=>(const Integer& a, const Integer& b) noexcept {
    return mpz_cmp(a.z_, b.z_) <=> 0;
  }

 private:
  mpz_t z_;
};

/// Non-negative greatest common divisor; gcd(0, 0) = 0.
[[nodiscard]] Integer gcd(const Integer& a, const Integer& b);
/// Least common multiple, non-negative.
[[nodiscard]] Integer lcm(const Integer& a, const Integer& b);
/// a / b where b divides a. Precondition: b != 0 and the division is exact.
[[nodiscard]] Integer exact_quotient(const Integer& a, const Integer& b);
/// Greatest integer <= a / b. Precondition: b != 0.
[[nodiscard]] Integer floor_quotient(const Integer& a, const Integer& b);
/// Least integer >= a / b. Precondition: b != 0.
[[nodiscard]] Integer ceil_quotient(const Integer& a, const Integer& b);

}  // namespace hexact
