// SPDX-License-Identifier: LGPL-3.0-or-later
#include "snapped_cut.hpp"

#include "homogeneous.hpp"
#include "instruction_sets.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace hexact::detail {
namespace {

using Vector = Point3<double>;

Vector operator-(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double norm1(const Vector& a) { return std::fabs(a.x) + std::fabs(a.y) + std::fabs(a.z); }

/// Widths of a plane: bits of the normal, and fraction bits of the offset by which all coefficients are scaled.
struct Widths {
  int normal;
  int fraction;
};

/// Rounding tilts the plane by 2^-(B−1) and moves it by 2^-(B−1+s): both have to stay 2^-guard below the depth.
Widths choose_widths(int log_slenderness, int log_depth, int guard) {
  const int by_tilt = log_slenderness + 1 + guard + 1;
  const int by_offset = guard - log_depth + 1;
  const int both = std::max({by_tilt, by_offset, 8});
  const int spare = guard - kLeastGuard;
  if (both - spare <= kShortNormal) return {std::min(both, kShortNormal), 0};
  const int normal = std::max({by_tilt > kWordNormal ? std::max(kWordNormal, by_tilt - spare) : by_tilt, 8});
  return {normal, std::max(0, by_offset - normal)};
}

using Fixed = Point3<Integer>;  // coordinates times 2^precision

Fixed operator-(const Fixed& a, const Fixed& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Integer dot(const Fixed& a, const Fixed& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
Fixed cross(const Fixed& a, const Fixed& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Integer magnitude(const Integer& a) { return a.sign() < 0 ? -a : a; }
Integer norm1(const Fixed& a) { return magnitude(a.x) + magnitude(a.y) + magnitude(a.z); }
Integer largest(const Fixed& a) { return std::max({magnitude(a.x), magnitude(a.y), magnitude(a.z)}); }
long log2(const Integer& a) { return static_cast<long>(a.bit_length()) - 1; }

/// Each coordinate rounded down: off by less than one unit.
Fixed to_fixed(const HomogeneousPoint& p, unsigned long precision) {
  return {floor_quotient(p.x.shifted_left(precision), p.w), floor_quotient(p.y.shifted_left(precision), p.w),
          floor_quotient(p.z.shifted_left(precision), p.w)};
}

/// λ·a + (1 − λ)·b, off by less than two units.
Fixed mix(const Rational& lambda, const Fixed& a, const Fixed& b) {
  if (lambda.is_zero()) return b;
  const Integer p = lambda.numerator(), q = lambda.denominator(), r = q - p;
  const auto coordinate = [&](const Integer& s, const Integer& t) { return floor_quotient(p * s + r * t, q); };
  return {coordinate(a.x, b.x), coordinate(a.y, b.y), coordinate(a.z, b.z)};
}

/// x·2^bits / size to the nearest integer; size > 0.
Integer rounded_quotient(const Integer& x, const Integer& size, unsigned long bits) {
  return floor_quotient(x.shifted_left(bits + 1) + size, size.shifted_left(1));
}

/// a / b for b > 0 to about 2^-51 relative.
double ratio(const Integer& a, const Integer& b) {
  long ea = 0, eb = 0;
  const double ma = mpz_get_d_2exp(&ea, a.raw());
  const double mb = mpz_get_d_2exp(&eb, b.raw());
  return std::ldexp(ma / mb, static_cast<int>(std::clamp(ea - eb, -2000L, 2000L)));
}

/// One attempt with coordinates of `precision` fraction bits.
std::optional<WideChoice> cut_with_precision(const ExactCorner& corner, int guard_bits, unsigned long precision) {
  const Fixed v = to_fixed(corner.v, precision);
  std::array<Fixed, 3> w, c;
  for (std::size_t i = 0; i < 3; ++i) {
    w[i] = to_fixed(corner.w[i], precision);
    c[i] = mix(corner.lambda[i], v, w[i]);
  }
  const Fixed e1 = c[1] - c[0], e2 = c[2] - c[0];
  const Fixed normal = cross(e1, e2);
  const Integer size = largest(normal);
  const Integer height = dot(normal, v - c[0]);  // depth of the cut times |normal|
  Integer distance(1);
  for (const Fixed& q : w) distance = std::max(distance, largest(q - v));
  const long span = std::max(log2(largest(e1)), log2(largest(e2))) + 1;
  // Points are off by two units, so the normal by about 2^(span+4); over `distance` that must not hide the depth.
  if (height.sign() <= 0 || log2(height) < span + 4 + log2(distance) + 12) return std::nullopt;
  const long log_depth = log2(height) - log2(size);
  if (log_depth < 16) return std::nullopt;
  const long bits = std::max<long>(8, log2(distance) - log_depth + guard_bits + 2);
  const auto width = static_cast<unsigned long>(bits);
  const Fixed n{rounded_quotient(normal.x, size, width), rounded_quotient(normal.y, size, width),
                rounded_quotient(normal.z, size, width)};
  const Integer margin = norm1(n) * Integer(2);
  std::array<Integer, 3> at_cut, at_w;
  for (std::size_t i = 0; i < 3; ++i) {
    at_cut[i] = dot(n, c[i]);
    at_w[i] = dot(n, w[i]);
  }
  const Integer at_v = dot(n, v);
  const Integer asked = std::max({at_cut[0], at_cut[1], at_cut[2]}) + margin;
  if (!(asked + margin < at_v)) return std::nullopt;
  // The offset keeps `guard_bits` below the height of v over the plane.
  const long coarse = std::min<long>(static_cast<long>(precision), log2(at_v - asked) - guard_bits);
  if (coarse < 0) return std::nullopt;
  Integer offset;
  mpz_cdiv_q_2exp(offset.raw(), asked.raw(), static_cast<unsigned long>(coarse));
  const Integer d = offset.shifted_left(static_cast<unsigned long>(coarse));
  if (!(d + margin < at_v)) return std::nullopt;
  WideChoice choice{{}, {0, 1}, static_cast<int>(bits)};
  const Integer slack = margin * Integer(4);
  for (std::size_t i = 0; i < 3; ++i) {
    const Integer rise = at_v - at_w[i];
    if (!(rise > slack)) return std::nullopt;
    choice.figures.change = std::max(choice.figures.change, ratio(d - at_cut[i] + margin, rise - slack) * (1 + 0x1p-40));
    choice.figures.min_parameter = std::min(
        choice.figures.min_parameter, std::max(0.0, ratio(d - at_w[i] - margin, rise + slack) * (1 - 0x1p-40)));
  }
  if (!(choice.figures.change < kLargestChange)) return std::nullopt;
  const auto fraction = precision - static_cast<unsigned long>(coarse);
  choice.plane = {n.x.shifted_left(fraction), n.y.shifted_left(fraction), n.z.shifted_left(fraction), offset};
  return choice;
}

/// The three functions below are those of the C library for the arguments that occur here, without its calls.
double power_of_two(int e) {  // −1022 <= e <= 1023
  return std::bit_cast<double>(static_cast<std::uint64_t>(e + 1023) << 52);
}
int floor_log2(double x) {  // x > 0 normal
  return static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52) - 1023;
}
double to_nearest(double x) {  // |x| < 2^51: the sum has no room for a fraction
  constexpr double kShift = 0x1.8p52;
  return (x + kShift) - kShift;
}
double up_to_integer(double x) {  // |x| < 2^62
  const auto i = static_cast<std::int64_t>(x);
  return static_cast<double>(i) < x ? static_cast<double>(i + 1) : static_cast<double>(i);
}

/// A plane in floating point before its offset is rounded, with what it says at the points of the corner.
struct CutProposal {
  Vector n;  ///< integers
  Widths widths;
  std::array<double, 3> at_cut, at_w;
  double at_v;
  double margin;  ///< bound of the errors of the values above
  double least;   ///< the smallest offset that is proved to cut no neighbour off further than asked
};

/// Coordinates are at most `extent` in magnitude.
[[gnu::always_inline]] inline std::optional<CutProposal> propose_cut(const CornerInDoubles& corner, double extent, int guard_bits) {
  std::array<Vector, 3> c;
  for (std::size_t i = 0; i < 3; ++i) {
    const double t = corner.lambda[i];
    const double s = 1 - t;
    c[i] = t == 0 ? corner.w[i]
                  : Vector{t * corner.v.x + s * corner.w[i].x, t * corner.v.y + s * corner.w[i].y,
                           t * corner.v.z + s * corner.w[i].z};
  }
  // The four roundings of a cut point move it by less than 2^-50 of the largest coordinate, in each coordinate.
  const double error = corner.error + 0x1p-50 * extent;
  const Vector e1 = c[1] - c[0], e2 = c[2] - c[0];
  const Vector normal = cross(e1, e2);
  const double length = std::sqrt(dot(normal, normal));
  const double depth = dot(normal, corner.v - c[0]) / length;
  const double span = std::max({norm1(e1), norm1(e2), norm1(c[2] - c[1])});
  double distance = 0;
  for (const Vector& w : corner.w) distance = std::max(distance, norm1(w - corner.v));
  // The direction is known to about error·span/length; its effect over `distance` has to stay well below the depth.
  if (!(depth > 0) || !(64 * error * span * distance < depth * length) || !(256 * error < depth)) return std::nullopt;
  CutProposal p{};
  p.widths = choose_widths(floor_log2(distance / depth), floor_log2(depth), guard_bits);
  if (p.widths.normal > kWordNormal) return std::nullopt;
  const double scale = power_of_two(p.widths.normal - 1) / length;
  p.n = {to_nearest(normal.x * scale), to_nearest(normal.y * scale), to_nearest(normal.z * scale)};
  for (std::size_t i = 0; i < 3; ++i) {
    p.at_cut[i] = dot(p.n, c[i]);
    p.at_w[i] = dot(p.n, corner.w[i]);
  }
  p.at_v = dot(p.n, corner.v);
  // |n|₁·error for the points, and five roundings of sums below |n|₁ times the largest coordinate.
  p.margin = norm1(p.n) * (error + 0x1p-50 * extent);
  p.least = std::max({p.at_cut[0], p.at_cut[1], p.at_cut[2]}) + p.margin;
  return p;
}

/// What the plane n·x = d realises; nullopt when that is not proved to be near what was asked.
[[gnu::always_inline]] inline std::optional<CutFigures> figures_of(const CutProposal& p, double d) {
  if (!(p.at_v - 2 * p.margin > d)) return std::nullopt;
  CutFigures figures{0, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    const double height = p.at_v - p.at_w[i];
    if (!(height > 8 * p.margin)) return std::nullopt;
    figures.change = std::max(figures.change,
                              (d - p.at_cut[i] + 2 * p.margin) / (height - 4 * p.margin) * (1 + 0x1p-40) + 0x1p-50);
    figures.min_parameter = std::min(
        figures.min_parameter, std::max(0.0, (d - p.at_w[i] - 2 * p.margin) / (height + 4 * p.margin) * (1 - 0x1p-40)));
  }
  if (!(figures.change < kLargestChange)) return std::nullopt;
  return figures;
}

/// (w − v) in units of the body, rounded once in each coordinate.
Vector difference(const FinePoint& w, const FinePoint& v) {
  return to_double(FinePoint{{w.at[0] - v.at[0], w.at[1] - v.at[1], w.at[2] - v.at[2]}});
}

}  // namespace

HEXACT_FOR_EACH_INSTRUCTION_SET
std::optional<CutChoice> cut_in_doubles(const CornerInDoubles& corner, int guard_bits) {
  constexpr double kExtent = 1 << kRangeBits;
  const auto p = propose_cut(corner, kExtent, guard_bits);
  if (!p || p->widths.normal + p->widths.fraction + kRangeBits + 2 > 62) return std::nullopt;
  const double unit = power_of_two(p->widths.fraction);
  const double least = p->least * unit;
  if (!(std::fabs(least) < 0x1p61)) return std::nullopt;
  const double offset = up_to_integer(least);
  // The quotient of an integer below 2^53 by a power of two is exact; above, the error is below the margin.
  const auto figures = figures_of(*p, offset / unit);
  if (!figures) return std::nullopt;
  return CutChoice{{static_cast<std::int64_t>(p->n.x * unit), static_cast<std::int64_t>(p->n.y * unit),
                    static_cast<std::int64_t>(p->n.z * unit), static_cast<std::int64_t>(offset)},
                   *figures};
}

std::optional<WideChoice> cut_in_words(const FineCorner& corner, int guard_bits) {
  using Wide = __int128;
  // In coordinates about v: there doubles resolve a cut that they could not in those of the body. Each point is
  // within two units of 2^-60.
  CornerInDoubles local{{0, 0, 0}, {}, corner.lambda, 0x1p-57};
  double extent = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    local.w[i] = difference(corner.w[i], corner.v);
    extent = std::max(extent, norm1(local.w[i]));
  }
  const auto p = propose_cut(local, extent, guard_bits);
  if (!p || p->widths.fraction > kFineBits) return std::nullopt;
  const std::array<std::int64_t, 3> n = {static_cast<std::int64_t>(p->n.x), static_cast<std::int64_t>(p->n.y),
                                         static_cast<std::int64_t>(p->n.z)};
  const Wide at_v = corner.v.at[0] * n[0] + corner.v.at[1] * n[1] + corner.v.at[2] * n[2];
  const int coarse = kFineBits - p->widths.fraction;
  const Wide least = at_v + static_cast<Wide>(p->least * 0x1p60) + 1;  // the conversion rounds toward zero
  const Wide offset = -(-least >> coarse);                             // up to the next multiple of 2^coarse
  const auto figures = figures_of(*p, static_cast<double>((offset << coarse) - at_v) * 0x1p-60);
  if (!figures) return std::nullopt;
  const auto fraction = static_cast<unsigned long>(p->widths.fraction);
  const auto entry = [&](std::int64_t x) { return Integer(static_cast<long long>(x)).shifted_left(fraction); };
  return WideChoice{{entry(n[0]), entry(n[1]), entry(n[2]), Integer(offset)}, *figures, p->widths.normal};
}

WideChoice cut_in_fixed_point(const ExactCorner& corner, int guard_bits) {
  for (unsigned long precision = 256;; precision *= 2) {
    if (auto choice = cut_with_precision(corner, guard_bits, precision)) return *choice;
    HEXACT_INVARIANT(precision < (1UL << 24));  // a million times the width of any corner seen
  }
}

}  // namespace hexact::detail
