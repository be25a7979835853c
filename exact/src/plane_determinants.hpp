// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"

#include <array>
#include <cmath>
#include <cstdint>

// Signs of determinants of integer planes (rows a b c d). Ladder: 64-bit minors with one 128-bit sum where the
// operands are short, then floating point with a proven bound, then big integers.
namespace hexact::detail {

using Row = IntegerPlanes::Narrow;

/// A superset of the bits of |x|, cheap.
inline std::uint64_t spread(std::int64_t x) noexcept { return static_cast<std::uint64_t>(x ^ (x >> 63)); }

inline std::uint64_t normal_spread(const Row& p) noexcept { return spread(p[0]) | spread(p[1]) | spread(p[2]); }

constexpr int kShortNormalBits = 22;
constexpr int kShortOffsetBits = 40;

/// |a|,|b|,|c| <= 2^22 and |d| <= 2^40: all 2×2 minors fit 63 bits and det4 fits 110 bits.
inline bool all_short(const Row& p, const Row& q, const Row& r, const Row& s) noexcept {
  const std::uint64_t normals = normal_spread(p) | normal_spread(q) | normal_spread(r) | normal_spread(s);
  const std::uint64_t offsets = spread(p[3]) | spread(q[3]) | spread(r[3]) | spread(s[3]);
  return (normals >> kShortNormalBits) == 0 && (offsets >> kShortOffsetBits) == 0;
}

template <class Wide, class Word>
inline int det4_sign(const std::array<Word, 4>& p, const std::array<Word, 4>& q, const std::array<Word, 4>& r,
                     const std::array<Word, 4>& s) {
  const auto minor = [](const auto& u, const auto& v, int i, int j) { return u[i] * v[j] - u[j] * v[i]; };
  const Wide det = Wide(minor(p, q, 0, 1)) * Wide(minor(r, s, 2, 3)) - Wide(minor(p, q, 0, 2)) * Wide(minor(r, s, 1, 3)) +
                   Wide(minor(p, q, 0, 3)) * Wide(minor(r, s, 1, 2)) + Wide(minor(p, q, 1, 2)) * Wide(minor(r, s, 0, 3)) -
                   Wide(minor(p, q, 1, 3)) * Wide(minor(r, s, 0, 2)) + Wide(minor(p, q, 2, 3)) * Wide(minor(r, s, 0, 1));
  if constexpr (std::is_same_v<Wide, Integer>) {
    return det.sign();
  } else {
    return det > 0 ? 1 : det < 0 ? -1 : 0;
  }
}

/// 0: undecided. Entries are rounded once (relative error ε = 2^-53 each), a product of minors has at most 9
/// factors (1 + ε), the sum of six adds 5: together below 16ε times the sum of the magnitudes.
inline int det4_filter(const Row& p, const Row& q, const Row& r, const Row& s) noexcept {
  double u[4][4];
  const Row* rows[4] = {&p, &q, &r, &s};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) u[i][j] = static_cast<double>((*rows[i])[static_cast<std::size_t>(j)]);
  double det = 0;
  double magnitude = 0;
  const auto term = [&](int i, int j, int k, int l, double sign) {
    const double x = u[0][i] * u[1][j], y = u[0][j] * u[1][i];
    const double z = u[2][k] * u[3][l], w = u[2][l] * u[3][k];
    det += sign * ((x - y) * (z - w));
    magnitude += (std::fabs(x) + std::fabs(y)) * (std::fabs(z) + std::fabs(w));
  };
  term(0, 1, 2, 3, 1);
  term(0, 2, 1, 3, -1);
  term(0, 3, 1, 2, 1);
  term(1, 2, 0, 3, 1);
  term(1, 3, 0, 2, -1);
  term(2, 3, 0, 1, 1);
  const double bound = 0x1p-48 * magnitude;
  return det > bound ? 1 : det < -bound ? -1 : 0;
}

inline std::array<Integer, 4> big_row(const Plane<Integer>& p) { return {p.a, p.b, p.c, p.d}; }

inline int sign_det4(const IntegerPlanes& planes, std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
  if (planes.is_narrow(i) && planes.is_narrow(j) && planes.is_narrow(k) && planes.is_narrow(l)) {
    const Row &p = planes.narrow(i), &q = planes.narrow(j), &r = planes.narrow(k), &s = planes.narrow(l);
    if (all_short(p, q, r, s)) return det4_sign<__int128, std::int64_t>(p, q, r, s);
    if (const int sign = det4_filter(p, q, r, s); sign != 0) return sign;
  }
  return det4_sign<Integer, Integer>(big_row(planes[i]), big_row(planes[j]), big_row(planes[k]), big_row(planes[l]));
}

inline int big_det3_sign(const Plane<Integer>& p, const Plane<Integer>& q, const Plane<Integer>& r) {
  return (p.a * (q.b * r.c - q.c * r.b) + p.b * (q.c * r.a - q.a * r.c) + p.c * (q.a * r.b - q.b * r.a)).sign();
}

/// 0: undecided. Entries, products and differences add at most 8 relative errors of 2^-53 to each term.
inline int det3_filter(const Row& p, const Row& q, const Row& r) noexcept {
  const auto x = [](std::int64_t e) { return static_cast<double>(e); };
  double det = 0;
  double magnitude = 0;
  const auto term = [&](std::size_t i, std::size_t j, std::size_t k) {
    const double u = x(q[j]) * x(r[k]), v = x(q[k]) * x(r[j]);
    det += x(p[i]) * (u - v);
    magnitude += std::fabs(x(p[i])) * (std::fabs(u) + std::fabs(v));
  };
  term(0, 1, 2);
  term(1, 2, 0);
  term(2, 0, 1);
  const double bound = 0x1p-48 * magnitude;
  return det > bound ? 1 : det < -bound ? -1 : 0;
}

inline int sign_det3(const IntegerPlanes& planes, std::size_t i, std::size_t j, std::size_t k) {
  if (planes.is_narrow(i) && planes.is_narrow(j) && planes.is_narrow(k)) {
    const Row &p = planes.narrow(i), &q = planes.narrow(j), &r = planes.narrow(k);
    // |n| < 2^40: minors < 2^81 and the sum < 2^123.
    if (((normal_spread(p) | normal_spread(q) | normal_spread(r)) >> 40) == 0) {
      using W = __int128;
      const W det = W(p[0]) * (W(q[1]) * r[2] - W(q[2]) * r[1]) + W(p[1]) * (W(q[2]) * r[0] - W(q[0]) * r[2]) +
                    W(p[2]) * (W(q[0]) * r[1] - W(q[1]) * r[0]);
      return det > 0 ? 1 : det < 0 ? -1 : 0;
    }
    if (const int sign = det3_filter(p, q, r); sign != 0) return sign;
  }
  return big_det3_sign(planes[i], planes[j], planes[k]);
}

}  // namespace hexact::detail
