// SPDX-License-Identifier: LGPL-3.0-or-later
// Numbers a + b√5, planes, and the signs of determinants that every proof of hexact-check rests on.
#pragma once

#include <gmpxx.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace check {

using Index = std::uint32_t;
constexpr Index kNone = UINT32_MAX;

// ---- numbers ---------------------------------------------------------------------------------------------------

struct Number {
  mpq_class a, b;
  Number() = default;
  explicit Number(int x) : a(x) {}
  explicit Number(mpq_class x, mpq_class y = 0) : a(std::move(x)), b(std::move(y)) {}
};
inline Number operator*(const Number& x, const Number& y) {
  if (x.b == 0 && y.b == 0) return Number(x.a * y.a);
  return Number(x.a * y.a + 5 * x.b * y.b, x.a * y.b + x.b * y.a);
}
inline Number operator+(const Number& x, const Number& y) { return Number(x.a + y.a, x.b + y.b); }
inline Number operator-(const Number& x, const Number& y) { return Number(x.a - y.a, x.b - y.b); }
inline bool is_zero(const Number& x) { return x.a == 0 && x.b == 0; }
inline int sign(const Number& x) {
  const int s = sgn(x.a), t = sgn(x.b);
  if (t == 0 || s == t) return s;
  if (s == 0) return t;
  const mpq_class a2 = x.a * x.a, b2 = 5 * x.b * x.b;  // never equal: √5 is irrational
  return a2 > b2 ? s : t;
}
inline Number quotient(const Number& x, const Number& y) {
  const mpq_class norm = y.a * y.a - 5 * y.b * y.b;
  return Number((x.a * y.a - 5 * x.b * y.b) / norm, (x.b * y.a - x.a * y.b) / norm);
}
inline mpq_class power_of_two(long e) {
  mpq_class q(1);
  if (e >= 0) mpq_mul_2exp(q.get_mpq_t(), q.get_mpq_t(), static_cast<mp_bitcnt_t>(e));
  else mpq_div_2exp(q.get_mpq_t(), q.get_mpq_t(), static_cast<mp_bitcnt_t>(-e));
  return q;
}
inline std::string text(const Number& x) {
  return x.b == 0 ? x.a.get_str() : x.a.get_str() + "+" + x.b.get_str() + "*sqrt5";
}

// ---- planes ----------------------------------------------------------------------------------------------------

using Row = std::array<std::int64_t, 4>;  // a b c d of ax + by + cz <= d, each of magnitude at most 2^62
using Plane = std::array<Number, 4>;

class Planes {
 public:
  std::size_t size() const { return rows_.size(); }
  void reserve(std::size_t n) { rows_.reserve(n); }
  bool is_short(std::size_t i) const { return rows_[i][3] != kBig; }
  const Row& row(std::size_t i) const { return rows_[i]; }
  Plane operator[](std::size_t i) const {
    if (!is_short(i)) return big_[static_cast<std::size_t>(rows_[i][0])];
    Plane p;
    for (std::size_t k = 0; k < 4; ++k) p[k] = Number(mpq_class(static_cast<long>(rows_[i][k])));
    return p;
  }
  void add(const Row& row) { rows_.push_back(row); }
  void add(const Plane& p) {
    rows_.push_back({static_cast<std::int64_t>(big_.size()), 0, 0, kBig});
    big_.push_back(p);
  }

 private:
  static constexpr std::int64_t kBig = std::numeric_limits<std::int64_t>::min();
  std::vector<Row> rows_;   // a row that ends in kBig begins with the place in big_
  std::vector<Plane> big_;
};

// ---- determinants ----------------------------------------------------------------------------------------------

// Laplace expansion in the numbers T. With kMinus = -1 the determinant, with +1 the permanent: of magnitudes it
// bounds the rounding error of the determinant.
template <int kMinus, class T, class R>
T expand3(const R& p, const R& q, const R& r) {
  const auto pair = [&](int i, int j) { return T(q[i]) * T(r[j]) + T(kMinus) * (T(q[j]) * T(r[i])); };
  return T(p[0]) * pair(1, 2) + T(kMinus) * (T(p[1]) * pair(0, 2)) + T(p[2]) * pair(0, 1);
}
template <int kMinus, class T, class R>
T expand4(const R& p, const R& q, const R& r, const R& s) {
  return T(s[3]) * expand3<kMinus, T>(p, q, r) + T(kMinus) * (T(r[3]) * expand3<kMinus, T>(p, q, s)) +
         T(q[3]) * expand3<kMinus, T>(p, r, s) + T(kMinus) * (T(p[3]) * expand3<kMinus, T>(q, r, s));
}
inline Number det3(const Plane& p, const Plane& q, const Plane& r) { return expand3<-1, Number>(p, q, r); }
inline Number det4(const Plane& p, const Plane& q, const Plane& r, const Plane& s) {
  return expand4<-1, Number>(p, q, r, s);
}

template <class T>
int sign_of(T x) {
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}
inline std::uint64_t magnitude(std::int64_t x) { return static_cast<std::uint64_t>(x ^ (x >> 63)); }
inline std::array<double, 4> magnitudes(const Row& r) {
  const auto m = [](std::int64_t x) { return std::fabs(static_cast<double>(x)); };
  return {m(r[0]), m(r[1]), m(r[2]), m(r[3])};
}

// det3 of the normals. With |entries| <= 2^40: six products of at most 2^120. Else in doubles as sign4 below.
inline int sign3(const Planes& planes, std::size_t i, std::size_t j, std::size_t k) {
  if (planes.is_short(i) && planes.is_short(j) && planes.is_short(k)) {
    const Row &p = planes.row(i), &q = planes.row(j), &r = planes.row(k);
    std::uint64_t bits = 0;
    for (const Row* row : {&p, &q, &r}) bits |= magnitude((*row)[0]) | magnitude((*row)[1]) | magnitude((*row)[2]);
    if (std::bit_width(bits) <= 40) return sign_of(expand3<-1, __int128>(p, q, r));
    const double value = expand3<-1, double>(p, q, r);
    if (std::fabs(value) > 0x1p-48 * expand3<1, double>(magnitudes(p), magnitudes(q), magnitudes(r))) return sign_of(value);
  }
  return sign(det3(planes[i], planes[j], planes[k]));
}

// det4 of four planes, normals within 2^n and offsets within 2^d: 24 products, so 128 bits hold it for 3n + d <= 122.
// Else in doubles: every conversion, product and sum adds a relative error of 2^-53, at most 13 of them on the way of
// a product to the result, so 2^-48 times the sum of the magnitudes bounds the error. Else in big numbers.
inline int sign4(const Planes& planes, std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
  if (planes.is_short(i) && planes.is_short(j) && planes.is_short(k) && planes.is_short(l)) {
    const Row &p = planes.row(i), &q = planes.row(j), &r = planes.row(k), &s = planes.row(l);
    std::uint64_t normals = 0, offsets = 0;
    for (const Row* row : {&p, &q, &r, &s}) {
      normals |= magnitude((*row)[0]) | magnitude((*row)[1]) | magnitude((*row)[2]);
      offsets |= magnitude((*row)[3]);
    }
    if (3 * std::bit_width(normals) + std::bit_width(offsets) <= 122) return sign_of(expand4<-1, __int128>(p, q, r, s));
    const double value = expand4<-1, double>(p, q, r, s);
    const double bound = 0x1p-48 * expand4<1, double>(magnitudes(p), magnitudes(q), magnitudes(r), magnitudes(s));
    if (std::fabs(value) > bound) return sign_of(value);
  }
  return sign(det4(planes[i], planes[j], planes[k], planes[l]));
}

// Sign of one component of the cross product of two normals.
inline int cross(const Planes& planes, std::size_t f, std::size_t g, int axis) {
  const auto u = static_cast<std::size_t>((axis + 1) % 3), v = static_cast<std::size_t>((axis + 2) % 3);
  if (planes.is_short(f) && planes.is_short(g)) {
    const Row &p = planes.row(f), &q = planes.row(g);
    return sign_of(static_cast<__int128>(p[u]) * q[v] - static_cast<__int128>(p[v]) * q[u]);
  }
  const Plane p = planes[f], q = planes[g];
  return sign(p[u] * q[v] - p[v] * q[u]);
}

// Whether p and q are the same half-space: positive multiples of each other.
inline bool same_half_space(const Plane& p, const Plane& q) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (is_zero(p[k]) != is_zero(q[k])) return false;
    if (is_zero(p[k])) continue;
    if (sign(p[k]) != sign(q[k])) return false;
    for (std::size_t i = 0; i < 4; ++i) {
      if (!is_zero(p[k] * q[i] - p[i] * q[k])) return false;
    }
    return true;
  }
  return false;
}

}  // namespace check
