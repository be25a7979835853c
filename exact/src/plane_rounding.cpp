// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/plane_body.hpp"

#include "homogeneous.hpp"
#include "hexact/kernel/progress.hpp"
#include "rounded_number.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <string>

namespace hexact {
namespace {

using Wide = __int128;
using detail::Rounded;
using detail::RoundedPoint;

// ------------------------------------------------------------------------------- Cramer in machine words

/// A vertex as numerators over one denominator; all exact.
struct WordPoint {
  std::array<Wide, 3> numerator;
  Wide denominator;
};

/// A plane n·x <= d·2^-shift with the common power of two of the normal taken out.
struct WordPlane {
  std::array<std::int64_t, 3> n;
  std::int64_t d;
  int shift;
};

WordPlane without_power_of_two(const IntegerPlanes::Narrow& p) {
  const int shift = std::countr_zero(static_cast<std::uint64_t>(p[0] | p[1] | p[2]));
  if (shift >= 64) return {{0, 0, 0}, p[3], 0};
  return {{p[0] >> shift, p[1] >> shift, p[2] >> shift}, p[3], shift};
}

int width(std::uint64_t bits) { return static_cast<int>(std::bit_width(bits)); }
std::uint64_t spread(std::int64_t x) { return static_cast<std::uint64_t>(x ^ (x >> 63)); }

/// Empty where a numerator might not fit 126 bits, or a 2×2 minor 63 bits.
std::optional<WordPoint> meet_in_words(const IntegerPlanes& planes, const std::array<FacetId, 3>& triple) {
  std::array<WordPlane, 3> p;
  int scale = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    if (!planes.is_narrow(index(triple[i]))) return std::nullopt;
    p[i] = without_power_of_two(planes.narrow(index(triple[i])));
    scale = std::max(scale, p[i].shift);
  }
  std::uint64_t normals = 0;
  int offset_bits = 0;
  for (const WordPlane& q : p) {
    normals |= spread(q.n[0]) | spread(q.n[1]) | spread(q.n[2]);
    offset_bits = std::max(offset_bits, width(spread(q.d)) + scale - q.shift);
  }
  const int normal_bits = width(normals);
  // A minor is below 2^(2·normal_bits + 1), the sum of three products below four times one product.
  if (normal_bits > 31 || offset_bits > 62 || offset_bits + 2 * normal_bits + 3 > 126) return std::nullopt;
  WordPoint m{{0, 0, 0}, 0};
  for (std::size_t i = 0; i < 3; ++i) {
    const auto &u = p[(i + 1) % 3].n, &v = p[(i + 2) % 3].n;
    const std::array<std::int64_t, 3> minor = {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2],
                                               u[0] * v[1] - u[1] * v[0]};
    const std::int64_t d = p[i].d * (std::int64_t{1} << (scale - p[i].shift));
    for (std::size_t k = 0; k < 3; ++k) m.numerator[k] += Wide(d) * minor[k];
    if (i == 0) m.denominator = Wide(p[0].n[0]) * minor[0] + Wide(p[0].n[1]) * minor[1] + Wide(p[0].n[2]) * minor[2];
  }
  if (normal_bits * 3 + 3 + scale > 126) return std::nullopt;
  m.denominator *= Wide(1) << scale;
  return m;
}

// ------------------------------------------------------------------------------- the floating-point filter

struct Sum {
  double high, low;
};
/// high + low = a + b exactly, high = fl(a + b) (Knuth).
Sum two_sum(double a, double b) {
  const double s = a + b;
  const double bb = s - a;
  return {s, (a - (s - bb)) + (b - bb)};
}

struct Quotient {
  Sum value;
  bool exact;  ///< known to be the quotient itself
};

/// p/q as an unevaluated sum, off by less than 2^-98 |p/q|. With p = ph + pl(1 + ε), q likewise (ε = 2^-53),
/// p/q = a + (p − aq)/q for a = fl(ph/qh); ph − a·qh is exact by fma; each further rounding is at most ε times
/// 4ε|p|, and replacing q by qh in the correction costs ε·4ε: together below 2^-100. Where p and q are doubles and
/// nothing is left of ph − a·qh, the quotient is a.
Quotient quotient(Wide p, Wide q) {
  const double ph = static_cast<double>(p), pl = static_cast<double>(p - static_cast<Wide>(ph));
  const double qh = static_cast<double>(q), ql = static_cast<double>(q - static_cast<Wide>(qh));
  const double a = ph / qh;
  const double left = std::fma(-a, qh, ph);
  return {two_sum(a, (left + (pl - a * ql)) / qh), left == 0 && pl == 0 && ql == 0};
}

/// What the coordinates of a body are multiplied by and moved by.
struct Placement {
  double factor = 1;
  std::array<double, 3> shift{};
};

/// Empty where doubles cannot hold scale and shift exactly, or under- or overflow could come near.
std::optional<Placement> placement_in_doubles(const PlaneBody& body) {
  if (std::labs(body.scale) > 400) return std::nullopt;
  Placement place;
  place.factor = std::ldexp(1.0, static_cast<int>(body.scale));
  for (std::size_t k = 0; k < 3; ++k) {
    const double s = body.shift[k].to_double();
    if (!std::isfinite(s) || Rational::from_double(s) != body.shift[k]) return std::nullopt;
    if (s != 0 && (std::fabs(s) < 0x1p-400 || std::fabs(s) > 0x1p400)) return std::nullopt;
    place.shift[k] = s;
  }
  return place;
}

/// The nearest double of p/q·factor + shift, where the filter can tell it. Numbers here lie between 2^-530 and
/// 2^530 or are 0, so nothing under- or overflows.
std::optional<Rounded> round_in_doubles(Wide p, Wide q, double factor, double shift) {
  if (p == 0) return Rounded{shift, 0};
  const auto [x, exact] = quotient(p, q);
  const Sum scaled{x.high * factor, x.low * factor};
  double bound = exact ? 0 : 0x1p-96 * std::fabs(scaled.high);
  Sum r = scaled;
  if (shift != 0) {
    const Sum moved = two_sum(shift, scaled.high);
    const double low = moved.low + scaled.low;
    if (!exact) bound += 0x1p-52 * std::fabs(low);  // an exact quotient has no low part to add
    r = two_sum(moved.high, low);
  }
  // fl is monotone: the exact value lies between r.high + (r.low ∓ bound), whose roundings must agree.
  if (!exact) bound = 2 * bound + 0x1p-52 * std::fabs(r.low);
  if (r.high + (r.low - bound) != r.high || r.high + (r.low + bound) != r.high) return std::nullopt;
  return Rounded{r.high, std::fabs(r.low) + bound};
}

// ------------------------------------------------------------------------------- exact

template <class S>
Point3<S> meet_in_field(const Plane<S>& p, const Plane<S>& q, const Plane<S>& r, VertexId v) {
  const auto cross = [](const Plane<S>& s, const Plane<S>& t) {
    return std::array<S, 3>{s.b * t.c - s.c * t.b, s.c * t.a - s.a * t.c, s.a * t.b - s.b * t.a};
  };
  const auto qr = cross(q, r), rp = cross(r, p), pq = cross(p, q);
  const S w = p.a * qr[0] + p.b * qr[1] + p.c * qr[2];
  if (w.is_zero()) {
    throw InvalidInput("DegenerateVertex", "the normals of its defining planes are dependent",
                       "vertex " + std::to_string(index(v)));
  }
  const auto coordinate = [&](std::size_t k) { return (p.d * qr[k] + q.d * rp[k] + r.d * pq[k]) / w; };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

/// The float32 of what is known by its nearest double; empty where that double does not tell.
std::optional<Rounded> in_format(const Rounded& r, FloatFormat format) {
  if (format == FloatFormat::binary64) return r;
  const float f = static_cast<float>(r.value);
  if (is_float_midpoint(r.value) || !std::isfinite(f)) return std::nullopt;
  const double value = static_cast<double>(f), error = std::fabs(r.value - value) + r.error;
  return Rounded{value, error == 0 ? 0 : detail::upper(error)};
}

template <class S>
RoundedPoint round_exactly(const Point3<S>& p, FloatFormat format) {
  return {detail::round_exactly(p.x, format), detail::round_exactly(p.y, format), detail::round_exactly(p.z, format)};
}

RoundedPoint round_vertex(const PlaneBody& body, const std::optional<Placement>& place, std::size_t v, FloatFormat format) {
  if (body.field == Field::sqrt5) return round_exactly(sqrt5_vertex(body, make_id<VertexId>(v)), format);
  if (place) {
    if (const auto m = meet_in_words(body.planes, body.triples[v]); m && m->denominator != 0) {
      RoundedPoint out{};
      bool decided = true;
      for (std::size_t k = 0; k < 3 && decided; ++k) {
        auto r = round_in_doubles(m->numerator[k], m->denominator, place->factor, place->shift[k]);
        if (r) r = in_format(*r, format);
        decided = r.has_value();
        if (decided) out[k] = *r;
      }
      if (decided) return out;
    }
  }
  return round_exactly(rational_vertex(body, make_id<VertexId>(v)), format);
}

}  // namespace

Point3<Rational> rational_vertex(const PlaneBody& body, VertexId v) {
  HEXACT_EXPECTS(body.field == Field::rational && index(v) < body.vertex_count());
  const auto& t = body.triples[index(v)];
  const auto m = detail::meet(body.planes[index(t[0])], body.planes[index(t[1])], body.planes[index(t[2])]);
  if (m.w.is_zero()) {
    throw InvalidInput("DegenerateVertex", "the normals of its defining planes are dependent",
                       "vertex " + std::to_string(index(v)));
  }
  const Point3<Rational> p = detail::to_point(m);
  return {p.x.scaled(body.scale) + body.shift[0], p.y.scaled(body.scale) + body.shift[1],
          p.z.scaled(body.scale) + body.shift[2]};
}

Point3<QuadraticField> sqrt5_vertex(const PlaneBody& body, VertexId v) {
  HEXACT_EXPECTS(index(v) < body.vertex_count());
  if (body.field == Field::rational) {
    const auto p = rational_vertex(body, v);
    return {p.x, p.y, p.z};
  }
  const auto& t = body.triples[index(v)];
  const auto p = meet_in_field(body.planes_sqrt5[index(t[0])], body.planes_sqrt5[index(t[1])],
                               body.planes_sqrt5[index(t[2])], v);
  const auto place = [&](const QuadraticField& x, std::size_t k) {
    return QuadraticField(x.rational_part().scaled(body.scale) + body.shift[k], x.sqrt5_part().scaled(body.scale));
  };
  return {place(p.x, 0), place(p.y, 1), place(p.z, 2)};
}

RoundedVertices rounded_vertices(const PlaneBody& body, FloatFormat format) { return rounded_vertices(body, format, {}); }

RoundedVertices rounded_vertices(const PlaneBody& body, FloatFormat format, const ProgressPart& progress) {
  const auto place = body.field == Field::rational ? placement_in_doubles(body) : std::nullopt;
  return detail::round_all(body.vertex_count(), 1 << 10, [&](std::size_t v) { return round_vertex(body, place, v, format); }, progress);
}

}  // namespace hexact
