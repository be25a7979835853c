// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "homogeneous_ring.hpp"
#include "plane_determinants.hpp"

#include <array>
#include <string>
#include <vector>

// Signs over planes with coefficients in Z or Z[√5], under the same names, and exact values for witnesses.
namespace hexact::detail {

struct RootPlanes {
  std::vector<Plane<RootInteger>> rows;
  [[nodiscard]] std::size_t size() const noexcept { return rows.size(); }
  [[nodiscard]] const Plane<RootInteger>& operator[](std::size_t i) const { return rows[i]; }
  void push_back(const Plane<RootInteger>& p) { rows.push_back(p); }
};

/// det4 of the rows (a b c d), expanded along the last column.
template <class R>
R det4(const Plane<R>& p, const Plane<R>& q, const Plane<R>& r, const Plane<R>& s) {
  return s.d * normal_determinant(p, q, r) - r.d * normal_determinant(p, q, s) + q.d * normal_determinant(p, r, s) -
         p.d * normal_determinant(q, r, s);
}

inline int sign_det3(const RootPlanes& p, std::size_t i, std::size_t j, std::size_t k) {
  return sign(normal_determinant(p[i], p[j], p[k]));
}
inline int sign_det4(const RootPlanes& p, std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
  return sign(det4(p[i], p[j], p[k], p[l]));
}

/// Sign of component `axis` of n_f × n_g.
template <class R>
int cross_sign(const Plane<R>& p, const Plane<R>& q, int axis) {
  if (axis == 0) return sign(p.b * q.c - p.c * q.b);
  if (axis == 1) return sign(p.c * q.a - p.a * q.c);
  return sign(p.a * q.b - p.b * q.a);
}
inline int cross_sign(const RootPlanes& planes, std::size_t f, std::size_t g, int axis) {
  return cross_sign(planes[f], planes[g], axis);
}
inline int cross_sign(const IntegerPlanes& planes, std::size_t f, std::size_t g, int axis) {
  if (!planes.is_narrow(f) || !planes.is_narrow(g)) return cross_sign(planes[f], planes[g], axis);
  const auto i = static_cast<std::size_t>((axis + 1) % 3), j = static_cast<std::size_t>((axis + 2) % 3);
  const Row &p = planes.narrow(f), &q = planes.narrow(g);
  const __int128 x = static_cast<__int128>(p[i]) * q[j] - static_cast<__int128>(p[j]) * q[i];
  return x > 0 ? 1 : x < 0 ? -1 : 0;
}

template <class R>
bool has_normal(const Plane<R>& p) {
  return !p.a.is_zero() || !p.b.is_zero() || !p.c.is_zero();
}
inline bool has_normal(const RootPlanes& planes, std::size_t f) { return has_normal(planes[f]); }
inline bool has_normal(const IntegerPlanes& planes, std::size_t f) {
  if (!planes.is_narrow(f)) return has_normal(planes.wide(f));
  const Row& p = planes.narrow(f);
  return p[0] != 0 || p[1] != 0 || p[2] != 0;
}

/// An axis that is not parallel to the normal: one after the first coefficient that is not 0.
template <class R>
int other_axis(const Plane<R>& p) {
  return !p.a.is_zero() ? 1 : !p.b.is_zero() ? 2 : 0;
}
inline int other_axis(const RootPlanes& planes, std::size_t f) { return other_axis(planes[f]); }
inline int other_axis(const IntegerPlanes& planes, std::size_t f) {
  if (!planes.is_narrow(f)) return other_axis(planes.wide(f));
  const Row& p = planes.narrow(f);
  return p[0] != 0 ? 1 : p[1] != 0 ? 2 : 0;
}

template <class Planes>
std::string det3_text(const Planes& p, std::size_t i, std::size_t j, std::size_t k) {
  return to_field(normal_determinant(p[i], p[j], p[k])).str();
}
template <class Planes>
std::string det4_text(const Planes& p, std::size_t i, std::size_t j, std::size_t k, std::size_t l) {
  return to_field(det4(p[i], p[j], p[k], p[l])).str();
}

}  // namespace hexact::detail
