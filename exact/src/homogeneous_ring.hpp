// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/kernel/errors.hpp"

#include <array>

// Planes and points in homogeneous coordinates over Z or Z[√5] without common factors, phs (h.1). Common factors
// are half of all digits (h.3), so they are removed wherever a vector is made.
namespace hexact::detail {

/// a + b√5 with integers a, b.
struct RootInteger {
  Integer a, b;
  RootInteger() = default;
  RootInteger(Integer x) : a(std::move(x)) {}  // NOLINT(google-explicit-constructor): integers embed exactly
  RootInteger(Integer x, Integer y) : a(std::move(x)), b(std::move(y)) {}
  [[nodiscard]] bool is_zero() const noexcept { return a.is_zero() && b.is_zero(); }
  [[nodiscard]] RootInteger operator-() const { return {-a, -b}; }
  friend RootInteger operator+(const RootInteger& x, const RootInteger& y) { return {x.a + y.a, x.b + y.b}; }
  friend RootInteger operator-(const RootInteger& x, const RootInteger& y) { return {x.a - y.a, x.b - y.b}; }
  friend RootInteger operator*(const RootInteger& x, const RootInteger& y) {
    if (x.b.is_zero() && y.b.is_zero()) return {x.a * y.a};
    return {x.a * y.a + Integer(5) * x.b * y.b, x.a * y.b + x.b * y.a};
  }
};

inline Rational to_field(const Integer& x) { return Rational(x); }
inline QuadraticField to_field(const RootInteger& x) { return {Rational(x.a), Rational(x.b)}; }
inline Rational ratio(const Integer& p, const Integer& q) { return Rational(p, q); }
inline QuadraticField ratio(const RootInteger& p, const RootInteger& q) { return to_field(p) / to_field(q); }
inline int sign(const Integer& x) { return x.sign(); }
inline int sign(const RootInteger& x) { return to_field(x).sign(); }

inline Integer content(const Integer& g, const Integer& x) { return gcd(g, x); }
inline Integer content(const Integer& g, const RootInteger& x) { return gcd(gcd(g, x.a), x.b); }
inline Integer divided(const Integer& x, const Integer& g) { return exact_quotient(x, g); }
inline RootInteger divided(const RootInteger& x, const Integer& g) {
  return {exact_quotient(x.a, g), exact_quotient(x.b, g)};
}
inline Integer common_denominator(const Integer& l, const Rational& x) { return lcm(l, x.denominator()); }
inline Integer common_denominator(const Integer& l, const QuadraticField& x) {
  return lcm(lcm(l, x.rational_part().denominator()), x.sqrt5_part().denominator());
}
inline Integer times(const Rational& x, const Integer& l) { return exact_quotient(x.numerator() * l, x.denominator()); }
inline RootInteger times(const QuadraticField& x, const Integer& l) {
  return {times(x.rational_part(), l), times(x.sqrt5_part(), l)};
}

template <class S>
struct RingOf;
template <>
struct RingOf<Rational> {
  using type = Integer;
};
template <>
struct RingOf<QuadraticField> {
  using type = RootInteger;
};
template <class S>
using Ring = typename RingOf<S>::type;

/// w > 0 is an ordinary integer in both rings.
template <class R>
struct RingPoint {
  R x, y, z;
  Integer w;
};

template <class S>
RingPoint<Ring<S>> to_ring(const Point3<S>& p) {
  const Integer w = common_denominator(common_denominator(common_denominator(Integer(1), p.x), p.y), p.z);
  return {times(p.x, w), times(p.y, w), times(p.z, w), w};
}

/// The plane with coefficients in the ring, without a common integer factor.
template <class S>
Plane<Ring<S>> to_ring(const Plane<S>& p) {
  const Integer l = common_denominator(
      common_denominator(common_denominator(common_denominator(Integer(1), p.a), p.b), p.c), p.d);
  Plane<Ring<S>> r{times(p.a, l), times(p.b, l), times(p.c, l), times(p.d, l)};
  const Integer g = content(content(content(content(Integer(0), r.a), r.b), r.c), r.d);
  if (g.is_zero() || g == Integer(1)) return r;
  return {divided(r.a, g), divided(r.b, g), divided(r.c, g), divided(r.d, g)};
}

/// One representative of all positive multiples: primitive integers.
inline Plane<Rational> canonical(const Plane<Integer>& p) {
  const Integer g = content(content(content(content(Integer(0), p.a), p.b), p.c), p.d);
  HEXACT_EXPECTS(!g.is_zero());
  return {divided(p.a, g), divided(p.b, g), divided(p.c, g), divided(p.d, g)};
}

/// The same over Z[√5]: the first coefficient of the normal that is not 0 is made rational, which also removes
/// common factors that are not rational.
inline Plane<QuadraticField> canonical(const Plane<RootInteger>& p) {
  QuadraticField pivot = to_field(!p.a.is_zero() ? p.a : !p.b.is_zero() ? p.b : p.c);
  HEXACT_EXPECTS(!pivot.is_zero());
  if (pivot.sign() < 0) pivot = -pivot;
  const Plane<QuadraticField> scaled{to_field(p.a) / pivot, to_field(p.b) / pivot, to_field(p.c) / pivot,
                                     to_field(p.d) / pivot};
  const Plane<RootInteger> r = to_ring(scaled);
  return {to_field(r.a), to_field(r.b), to_field(r.c), to_field(r.d)};
}

template <class R>
R det3(const R& a, const R& b, const R& c, const R& d, const R& e, const R& f, const R& g, const R& h, const R& i) {
  return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
}

/// n·x − d·w for the plane and the point: positive beyond the plane.
template <class R>
R height(const Plane<R>& p, const RingPoint<R>& x) {
  return p.a * x.x + p.b * x.y + p.c * x.z - p.d * R(x.w);
}

/// λ·v + (1 − λ)·w, eq. (0.1), with λ = p/q.
template <class R>
RingPoint<R> cut_point(const R& p, const Integer& q, const RingPoint<R>& v, const RingPoint<R>& w) {
  if (p.is_zero()) return w;
  const R s = p * R(w.w), t = (R(q) - p) * R(v.w);
  RingPoint<R> e{s * v.x + t * w.x, s * v.y + t * w.y, s * v.z + t * w.z, q * v.w * w.w};
  const Integer g = content(content(content(content(Integer(0), e.x), e.y), e.z), e.w);
  return {divided(e.x, g), divided(e.y, g), divided(e.z, g), exact_quotient(e.w, g)};
}

/// The plane through three points as signed 3×3 minors, oriented so that `beyond` is strictly beyond it.
/// Throws InvalidInput (NotConvex) where the points do not span such a plane.
template <class R>
Plane<R> plane_through(const std::array<RingPoint<R>, 3>& e, const RingPoint<R>& beyond, std::size_t vertex) {
  const R w0(e[0].w), w1(e[1].w), w2(e[2].w);
  Plane<R> p{det3(e[0].y, e[0].z, w0, e[1].y, e[1].z, w1, e[2].y, e[2].z, w2),
             -det3(e[0].x, e[0].z, w0, e[1].x, e[1].z, w1, e[2].x, e[2].z, w2),
             det3(e[0].x, e[0].y, w0, e[1].x, e[1].y, w1, e[2].x, e[2].y, w2),
             det3(e[0].x, e[0].y, e[0].z, e[1].x, e[1].y, e[1].z, e[2].x, e[2].y, e[2].z)};
  const int side = sign(height(p, beyond));
  if (side == 0) {
    throw InvalidInput("NotConvex", "lies in the plane that should cut it off", "vertex " + std::to_string(vertex));
  }
  if (side < 0) p = {-p.a, -p.b, -p.c, -p.d};
  return p;
}

/// det of the three normals.
template <class R>
R normal_determinant(const Plane<R>& p, const Plane<R>& q, const Plane<R>& r) {
  return det3(p.a, p.b, p.c, q.a, q.b, q.c, r.a, r.b, r.c);
}

}  // namespace hexact::detail
