// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "plane_determinants.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>

// Four numbers at a time, in the vector types of GCC and clang. Each lane computes exactly what a double would.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"  // vectors are passed between inlined functions only
#endif

namespace hexact::detail {

using Four = double __attribute__((vector_size(32)));
using FourWords = std::int64_t __attribute__((vector_size(32)));

[[gnu::always_inline]] inline double magnitude(double x) { return std::fabs(x); }
[[gnu::always_inline]] inline Four magnitude(const Four& x) {
  FourWords bits;
  std::memcpy(&bits, &x, sizeof bits);
  bits &= INT64_MAX;
  Four result;
  std::memcpy(&result, &bits, sizeof result);
  return result;
}

/// The coefficients of four planes, a[i] being that of plane i.
struct FourPlanes {
  Four a, b, c, d;
};

/// Converts four rows; false, and no promise about the result, where an entry has more than 50 bits or a row stands
/// for a wide plane.
[[gnu::always_inline]] inline bool load_planes(const std::array<const Row*, 4>& rows, FourPlanes& planes) {
  FourWords bits = {0, 0, 0, 0};
  Four row[4];
  for (int i = 0; i < 4; ++i) {
    FourWords x;
    std::memcpy(&x, rows[static_cast<std::size_t>(i)]->data(), sizeof x);
    bits |= x ^ (x >> 63);
    // Integers below 2^51 are the low bits of 1.5·2^52 plus themselves.
    x += std::int64_t{0x4338000000000000};
    std::memcpy(&row[i], &x, sizeof x);
    row[i] -= 0x1.8p52;
  }
  const Four ab = __builtin_shufflevector(row[0], row[1], 0, 4, 2, 6), cd = __builtin_shufflevector(row[0], row[1], 1, 5, 3, 7);
  const Four ef = __builtin_shufflevector(row[2], row[3], 0, 4, 2, 6), gh = __builtin_shufflevector(row[2], row[3], 1, 5, 3, 7);
  planes.a = __builtin_shufflevector(ab, ef, 0, 1, 4, 5);
  planes.c = __builtin_shufflevector(ab, ef, 2, 3, 6, 7);
  planes.b = __builtin_shufflevector(cd, gh, 0, 1, 4, 5);
  planes.d = __builtin_shufflevector(cd, gh, 2, 3, 6, 7);
  return (static_cast<std::uint64_t>(bits[0] | bits[1] | bits[2] | bits[3]) >> 50) == 0;
}

}  // namespace hexact::detail
