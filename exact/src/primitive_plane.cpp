// SPDX-License-Identifier: LGPL-3.0-or-later
#include "primitive_plane.hpp"

#include "facet_geometry.hpp"
#include "homogeneous.hpp"

#include "hexact/kernel/errors.hpp"
#include "hexact/kernel/mesh_topology.hpp"

#include <algorithm>
#include <array>
#include <limits>

namespace hexact::detail {
namespace {

// Offsets that share a power of two are left as they are while they fit a machine word: a cube of side 4 keeps scale 0.
constexpr std::size_t kWordBits = 62;

/// Largest k with 2^k | x, for x ≠ 0.
long valuation(const Integer& x) { return static_cast<long>(mpz_scan1(x.raw(), 0)); }

template <std::size_t N>
Integer common_denominator(const std::array<const Rational*, N>& numbers) {
  Integer denominator(1);
  for (const Rational* x : numbers) denominator = lcm(denominator, x->denominator());
  return denominator;
}

Integer times(const Rational& x, const Integer& denominator) {
  return x.numerator() * exact_quotient(denominator, x.denominator());
}

template <class S>
Point3<S> meet_by_division(const Plane<S>& p, const Plane<S>& q, const Plane<S>& r, std::size_t vertex) {
  const Point3<S> qr = cross(normal(q), normal(r)), rp = cross(normal(r), normal(p)), pq = cross(normal(p), normal(q));
  const S w = dot(normal(p), qr);
  if (w.is_zero()) {
    throw InvalidInput("DegenerateVertex", "its three planes do not meet in one point", vertex_name(vertex));
  }
  const Point3<S> m = p.d * qr + q.d * rp + r.d * pq;
  return {m.x / w, m.y / w, m.z / w};
}

}  // namespace

Plane<Integer> primitive(const Plane<Integer>& plane) {
  const Integer content = gcd(gcd(plane.a, plane.b), gcd(plane.c, plane.d));
  if (content == Integer(1) || content.is_zero()) return plane;
  return {exact_quotient(plane.a, content), exact_quotient(plane.b, content), exact_quotient(plane.c, content),
          exact_quotient(plane.d, content)};
}

Plane<Integer> primitive(const Plane<Rational>& plane) {
  const Integer common = common_denominator<4>({&plane.a, &plane.b, &plane.c, &plane.d});
  return primitive(Plane<Integer>{times(plane.a, common), times(plane.b, common), times(plane.c, common),
                                  times(plane.d, common)});
}

Plane<QuadraticField> primitive(const Plane<QuadraticField>& plane) {
  std::array<const Rational*, 8> parts{};
  std::size_t i = 0;
  for (const QuadraticField* x : {&plane.a, &plane.b, &plane.c, &plane.d}) {
    parts[i++] = &x->rational_part();
    parts[i++] = &x->sqrt5_part();
  }
  const Integer common = common_denominator<8>(parts);
  Integer content(0);
  for (const Rational* x : parts) content = gcd(content, times(*x, common));
  if (content.is_zero()) return plane;
  const Rational factor(common, content);
  const auto scaled = [&](const QuadraticField& x) {
    return QuadraticField(x.rational_part() * factor, x.sqrt5_part() * factor);
  };
  return {scaled(plane.a), scaled(plane.b), scaled(plane.c), scaled(plane.d)};
}

long shortening_scale(const std::vector<Plane<Integer>>& file_planes) {
  long scale = std::numeric_limits<long>::max();
  bool long_offset = false;
  for (const Plane<Integer>& p : file_planes) {
    if (p.d.is_zero()) continue;
    long_offset = long_offset || p.d.bit_length() > kWordBits;
    scale = std::min(scale, valuation(p.d) - valuation(gcd(gcd(p.a, p.b), p.c)));
  }
  if (scale == std::numeric_limits<long>::max()) return 0;
  return scale < 0 || long_offset ? scale : 0;
}

Plane<Integer> scaled_plane(const Plane<Integer>& p, long scale) {
  if (scale == 0) return primitive(p);
  if (scale < 0) {
    return primitive(Plane<Integer>{p.a, p.b, p.c, p.d.shifted_left(static_cast<unsigned long>(-scale))});
  }
  const auto bits = static_cast<unsigned long>(scale);
  return primitive(Plane<Integer>{p.a.shifted_left(bits), p.b.shifted_left(bits), p.c.shifted_left(bits), p.d});
}

Plane<Rational> file_plane(const PlaneBody& body, std::size_t f) {
  const Plane<Integer> p = body.planes[f];
  const Rational a(p.a), b(p.b), c(p.c);
  return {a, b, c,
          Rational(p.d).scaled(body.scale) + a * body.shift[0] + b * body.shift[1] + c * body.shift[2]};
}

Plane<QuadraticField> file_plane_sqrt5(const PlaneBody& body, std::size_t f) {
  const Plane<QuadraticField>& p = body.planes_sqrt5[f];
  const QuadraticField scaled(p.d.rational_part().scaled(body.scale), p.d.sqrt5_part().scaled(body.scale));
  return {p.a, p.b, p.c, scaled + p.a * QuadraticField(body.shift[0]) + p.b * QuadraticField(body.shift[1]) +
                             p.c * QuadraticField(body.shift[2])};
}

Point3<Rational> meet_planes(const Plane<Rational>& p, const Plane<Rational>& q, const Plane<Rational>& r,
                             std::size_t vertex) {
  return meet_by_division(p, q, r, vertex);
}

Point3<QuadraticField> meet_planes(const Plane<QuadraticField>& p, const Plane<QuadraticField>& q,
                                   const Plane<QuadraticField>& r, std::size_t vertex) {
  return meet_by_division(p, q, r, vertex);
}

Point3<Rational> meet_in_file_coordinates(const PlaneBody& body, VertexId v) {
  const auto& t = body.triples[index(v)];
  const HomogeneousPoint m = meet(body.planes[index(t[0])], body.planes[index(t[1])], body.planes[index(t[2])]);
  if (m.w.is_zero()) {
    throw InvalidInput("DegenerateVertex", "its three planes do not meet in one point", vertex_name(index(v)));
  }
  const Point3<Rational> p = to_point(m);
  return {p.x.scaled(body.scale) + body.shift[0], p.y.scaled(body.scale) + body.shift[1],
          p.z.scaled(body.scale) + body.shift[2]};
}

Point3<QuadraticField> meet_in_file_coordinates_sqrt5(const PlaneBody& body, VertexId v) {
  const auto& t = body.triples[index(v)];
  return meet_by_division(file_plane_sqrt5(body, index(t[0])), file_plane_sqrt5(body, index(t[1])),
                          file_plane_sqrt5(body, index(t[2])), index(v));
}

}  // namespace hexact::detail
