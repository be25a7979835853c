// SPDX-License-Identifier: LGPL-3.0-or-later
#include "snapped_vertices.hpp"

#include "four_lanes.hpp"
#include "homogeneous.hpp"
#include "instruction_sets.hpp"
#include "word_points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace hexact::detail {
namespace {

/// A float above the bound: the conversion is off by at most 2^-24 of it (bounds here are far from underflow).
float upward(double bound) { return static_cast<float>(bound * (1 + 0x1p-22)); }

LocatedVertex locate_exactly(const IntegerPlanes& planes, std::uint32_t f, std::uint32_t g, std::uint32_t h) {
  const auto m = oriented_meet(planes[f], planes[g], planes[h]);
  if (m.w.is_zero()) return {{0, 0, 0}, std::numeric_limits<float>::infinity()};
  // Three coordinates below 2^19 in magnitude, each rounded down to a multiple of 2^-34: off by less than 2^-33.
  const auto coordinate = [&](const Integer& x) {
    return std::ldexp(mpz_get_d(floor_quotient(x.shifted_left(34), m.w).raw()), -34);
  };
  const bool proper = m.w.sign() > 0;
  return {{coordinate(m.x), coordinate(m.y), coordinate(m.z)}, proper ? 0x1p-33f : std::numeric_limits<float>::infinity()};
}

/// In words where the planes fit, in big integers where they do not or the corner is too flat.
LocatedVertex locate_in_words(const IntegerPlanes& planes, std::uint32_t f, std::uint32_t g, std::uint32_t h,
                              const Point3<double>& guess) {
  const auto p = word_plane(planes, f), q = word_plane(planes, g), r = word_plane(planes, h);
  if (p && q && r) {
    if (const auto point = meet_in_words({*p, *q, *r}, guess)) return {to_double(*point), 0x1p-33f};
  }
  return locate_exactly(planes, f, g, h);
}

bool has_exact_normal(const Row& p) { return (normal_spread(p) >> 53) == 0; }

template <class V>
struct PlaneIn {
  V a, b, c, d;
  V low;  ///< the offset is d + low
};
template <class V>
struct Vector {
  V x, y, z;
};

template <class V>
[[gnu::always_inline]] inline V norm1(const V& x, const V& y, const V& z) {
  return magnitude(x) + magnitude(y) + magnitude(z);
}

template <class V>
struct Solution {
  Vector<V> point;
  V bound;
  V smallest_det, det;  ///< the bound holds where the first is below the second
};

/// Solves for the point of three planes n·x = d by one correction of a guess (Cramer's rule on the residuals r),
/// and bounds the error by the residuals that remain: x − p = Σ rᵢ (nⱼ × nₖ) / det, whatever the lengths of the n.
/// The determinant of the normals, which the bound needs anyway, is proved positive on the way.
template <class V>
[[gnu::always_inline]] inline Solution<V> solve(const PlaneIn<V> (&n)[3], const Vector<V>& guess) {
  Vector<V> x = guess;
  Vector<V> cross[3];
  for (int i = 0; i < 3; ++i) {
    const PlaneIn<V>&u = n[(i + 1) % 3], &v = n[(i + 2) % 3];
    cross[i] = {u.b * v.c - u.c * v.b, u.c * v.a - u.a * v.c, u.a * v.b - u.b * v.a};
  }
  const V det = n[0].a * cross[0].x + n[0].b * cross[0].y + n[0].c * cross[0].z;
  const V inverse = 1 / det;
  V r[3];
  for (int i = 0; i < 3; ++i) r[i] = (n[i].d - n[i].a * x.x - n[i].b * x.y - n[i].c * x.z) + n[i].low;
  x.x += inverse * (r[0] * cross[0].x + r[1] * cross[1].x + r[2] * cross[2].x);
  x.y += inverse * (r[0] * cross[0].y + r[1] * cross[1].y + r[2] * cross[2].y);
  x.z += inverse * (r[0] * cross[0].z + r[1] * cross[1].z + r[2] * cross[2].z);
  const V length[3] = {norm1(n[0].a, n[0].b, n[0].c), norm1(n[1].a, n[1].b, n[1].c), norm1(n[2].a, n[2].b, n[2].c)};
  V sum{};
  for (int i = 0; i < 3; ++i) {
    const V tx = n[i].a * x.x, ty = n[i].b * x.y, tz = n[i].c * x.z;
    const V left = magnitude((n[i].d - tx - ty - tz) + n[i].low);
    const V rounding = 0x1.8p-51 * (norm1(tx, ty, tz) + magnitude(n[i].d));
    sum += (left + rounding) * (norm1(cross[i].x, cross[i].y, cross[i].z) + 0x1p-50 * length[(i + 1) % 3] * length[(i + 2) % 3]);
  }
  // The computed determinant is off by less than 2^-49 |n₁||n₂||n₃|; where that is below 2^-9 of it, 1/det is at most
  // (1 + 2^-8) times what was computed.
  return {x, sum * inverse * (1 + 0x1p-7), 0x1p-40 * length[0] * length[1] * length[2], det};
}

/// Errors up to this are good enough; larger ones are worth 128-bit words.
constexpr double kGoodError = 0x1p-18;

/// Four corners at once; false, and nothing written, where doubles do not suffice for all four.
[[gnu::always_inline]] inline bool locate_four(const IntegerPlanes& planes, const Corner* corners, Point3<double>* points, float* errors) {
  FourPlanes rows[3];
  for (std::size_t k = 0; k < 3; ++k) {
    const std::array<const Row*, 4> four = {&planes.row(corners[0].planes[k]), &planes.row(corners[1].planes[k]),
                                            &planes.row(corners[2].planes[k]), &planes.row(corners[3].planes[k])};
    if (!load_planes(four, rows[k])) return false;
  }
  PlaneIn<Four> n[3];
  for (int k = 0; k < 3; ++k) n[k] = PlaneIn<Four>{rows[k].a, rows[k].b, rows[k].c, rows[k].d, Four{}};
  Vector<Four> guess;
  for (int i = 0; i < 4; ++i) {
    guess.x[i] = corners[i].guess.x;
    guess.y[i] = corners[i].guess.y;
    guess.z[i] = corners[i].guess.z;
  }
  const Solution<Four> s = solve<Four>(n, guess);
  const FourWords good = (s.smallest_det < s.det) & (s.bound < kGoodError);
  if ((good[0] & good[1] & good[2] & good[3]) == 0) return false;
  for (int i = 0; i < 4; ++i) {
    points[i] = {s.point.x[i], s.point.y[i], s.point.z[i]};
    errors[i] = upward(s.bound[i]);
  }
  return true;
}

}  // namespace

LocatedVertex locate_vertex(const IntegerPlanes& planes, std::uint32_t f, std::uint32_t g, std::uint32_t h,
                            const Point3<double>& guess) {
  if (!planes.is_narrow(f) || !planes.is_narrow(g) || !planes.is_narrow(h)) return locate_in_words(planes, f, g, h, guess);
  const Row* rows[3] = {&planes.narrow(f), &planes.narrow(g), &planes.narrow(h)};
  PlaneIn<double> n[3];  // offsets of up to 62 bits as a sum of two doubles
  for (int i = 0; i < 3; ++i) {
    const Row& p = *rows[i];
    if (!has_exact_normal(p)) return locate_in_words(planes, f, g, h, guess);
    const auto d = static_cast<double>(p[3]);
    n[i] = {static_cast<double>(p[0]), static_cast<double>(p[1]), static_cast<double>(p[2]), d,
            static_cast<double>(p[3] - static_cast<std::int64_t>(d))};
  }
  const Solution<double> s = solve<double>(n, {guess.x, guess.y, guess.z});
  if (!(s.smallest_det < s.det) || !(s.bound < kGoodError)) return locate_in_words(planes, f, g, h, guess);
  return {{s.point.x, s.point.y, s.point.z}, upward(s.bound)};
}

HEXACT_FOR_EACH_INSTRUCTION_SET
void locate_vertices(const IntegerPlanes& planes, std::span<const Corner> corners, Point3<double>* points, float* errors) {
  for (std::size_t i = 0; i < corners.size();) {
    if (corners.size() - i >= 4 && locate_four(planes, &corners[i], points + i, errors + i)) {
      i += 4;
      continue;
    }
    for (const std::size_t stop = std::min(i + 4, corners.size()); i < stop; ++i) {
      const auto& [p, guess] = corners[i];
      const LocatedVertex found = locate_vertex(planes, p[0], p[1], p[2], guess);
      points[i] = found.point;
      errors[i] = found.error;
    }
  }
}

}  // namespace hexact::detail
