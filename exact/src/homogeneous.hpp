// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/kernel/errors.hpp"

// Points in homogeneous integer coordinates, as 3×3 minors of their three planes.
namespace hexact::detail {

struct HomogeneousPoint {
  Integer x, y, z, w;  ///< w > 0
};

/// The point of three planes, w being the determinant of their normals, of either sign.
inline HomogeneousPoint oriented_meet(const Plane<Integer>& p, const Plane<Integer>& q, const Plane<Integer>& r) {
  const auto cross = [](const Plane<Integer>& u, const Plane<Integer>& v) {
    return std::array<Integer, 3>{u.b * v.c - u.c * v.b, u.c * v.a - u.a * v.c, u.a * v.b - u.b * v.a};
  };
  const auto qr = cross(q, r), rp = cross(r, p), pq = cross(p, q);
  HomogeneousPoint m;
  m.w = p.a * qr[0] + p.b * qr[1] + p.c * qr[2];
  m.x = p.d * qr[0] + q.d * rp[0] + r.d * pq[0];
  m.y = p.d * qr[1] + q.d * rp[1] + r.d * pq[1];
  m.z = p.d * qr[2] + q.d * rp[2] + r.d * pq[2];
  return m;
}

/// The point of three planes; w = 0 where their normals are dependent.
inline HomogeneousPoint meet(const Plane<Integer>& p, const Plane<Integer>& q, const Plane<Integer>& r) {
  HomogeneousPoint m = oriented_meet(p, q, r);
  if (m.w.sign() < 0) m = {-m.x, -m.y, -m.z, -m.w};
  return m;
}

inline Point3<Rational> to_point(const HomogeneousPoint& m) {
  return {Rational(m.x, m.w), Rational(m.y, m.w), Rational(m.z, m.w)};
}

inline Point3<double> to_double(const Point3<Rational>& p) {
  return {p.x.to_double(), p.y.to_double(), p.z.to_double()};
}

/// floor(log2 x) or one less, for x > 0.
inline long floor_log2(const Rational& x) {
  return static_cast<long>(x.numerator().bit_length()) - static_cast<long>(x.denominator().bit_length()) - 1;
}

}  // namespace hexact::detail
