// SPDX-License-Identifier: LGPL-3.0-or-later
#include "snapped_vertices.hpp"

#include "four_lanes.hpp"
#include "homogeneous.hpp"
#include "instruction_sets.hpp"
#include "word_points.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace hexact::detail {
namespace {

constexpr std::size_t kGrain = 1 << 12;

/// A float above the bound: the conversion is off by at most 2^-24 of it (bounds here are far from underflow).
float upward(double bound) { return static_cast<float>(bound * (1 + 0x1p-22)); }

struct LocatedVertex {
  Point3<double> point;
  float error;
};

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

LocatedVertex locate_in_doubles(const IntegerPlanes& planes, std::uint32_t f, std::uint32_t g, std::uint32_t h,
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

/// The vertices of the half-edges h … h + 3 of the level before: all at once where doubles suffice for all four.
[[gnu::always_inline]] inline bool locate_four(const HoneycombMap& map, const RawVector<Point3<double>>& old_points,
                                               const IntegerPlanes& planes, std::uint32_t h, Point3<double>* points, float* errors) {
  const auto old_facets = static_cast<std::uint32_t>(map.facet_count());
  std::array<const Row*, 4> f, a, b;
  Vector<Four> guess;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t v = map.origin(h + i), w = map.target(h + i);
    f[i] = &planes.row(map.facet(h + i));
    a[i] = &planes.row(old_facets + v);
    b[i] = &planes.row(old_facets + w);
    const Point3<double>&p = old_points[v], &q = old_points[w];
    guess.x[i] = (p.x + q.x) / 2;
    guess.y[i] = (p.y + q.y) / 2;
    guess.z[i] = (p.z + q.z) / 2;
  }
  FourPlanes rows[3];
  if (!load_planes(f, rows[0]) || !load_planes(a, rows[1]) || !load_planes(b, rows[2])) return false;
  PlaneIn<Four> n[3];
  for (int i = 0; i < 3; ++i) n[i] = PlaneIn<Four>{rows[i].a, rows[i].b, rows[i].c, rows[i].d, Four{}};
  const Solution<Four> s = solve<Four>(n, guess);
  const FourWords good = (s.smallest_det < s.det) & (s.bound < kGoodError);
  if ((good[0] & good[1] & good[2] & good[3]) == 0) return false;
  for (int i = 0; i < 4; ++i) {
    points[i] = {s.point.x[i], s.point.y[i], s.point.z[i]};
    errors[i] = upward(s.bound[i]);
  }
  return true;
}

HEXACT_FOR_EACH_INSTRUCTION_SET
void locate_range(const HoneycombMap& map, const RawVector<Point3<double>>& old_points, const IntegerPlanes& planes,
                  std::uint32_t begin, std::uint32_t end, RawVector<Point3<double>>& points, RawVector<float>& errors) {
  const auto old_facets = static_cast<std::uint32_t>(map.facet_count());
  for (std::uint32_t h = begin; h < end;) {
    if (end - h >= 4 && locate_four(map, old_points, planes, h, &points[h], &errors[h])) {
      h += 4;
      continue;
    }
    for (const std::uint32_t stop = std::min(h + 4, end); h < stop; ++h) {
      const std::uint32_t v = map.origin(h), w = map.target(h);
      const Point3<double>&p = old_points[v], &q = old_points[w];
      const LocatedVertex found = locate_in_doubles(planes, map.facet(h), old_facets + v, old_facets + w,
                                                    {(p.x + q.x) / 2, (p.y + q.y) / 2, (p.z + q.z) / 2});
      points[h] = found.point;
      errors[h] = found.error;
    }
  }
}

}  // namespace

void locate_vertices(const HoneycombMap& map, const RawVector<Point3<double>>& old_points, const IntegerPlanes& planes,
                     RawVector<Point3<double>>& points, RawVector<float>& errors) {
  const auto count = static_cast<std::uint32_t>(map.half_edge_count());
  points.resize(count);
  errors.resize(count);
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, count, kGrain), [&](const auto& range) {
    locate_range(map, old_points, planes, range.begin(), range.end(), points, errors);
  });
}

}  // namespace hexact::detail
