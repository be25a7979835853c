// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/kernel/mesh_topology.hpp"

#include <array>
#include <optional>
#include <span>
#include <vector>

// Exact geometry of polygons over any ordered ring R with +, −, * and sign: Integer, Rational, QuadraticField.
namespace hexact::detail {

template <class R>
Point3<R> operator-(const Point3<R>& p, const Point3<R>& q) {
  return {p.x - q.x, p.y - q.y, p.z - q.z};
}
template <class R>
Point3<R> operator+(const Point3<R>& p, const Point3<R>& q) {
  return {p.x + q.x, p.y + q.y, p.z + q.z};
}
template <class R>
Point3<R> operator*(const R& s, const Point3<R>& p) {
  return {s * p.x, s * p.y, s * p.z};
}
template <class R>
Point3<R> cross(const Point3<R>& p, const Point3<R>& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}
template <class R>
R dot(const Point3<R>& p, const Point3<R>& q) {
  return p.x * q.x + p.y * q.y + p.z * q.z;
}
template <class R>
bool is_zero(const Point3<R>& p) {
  return p.x.is_zero() && p.y.is_zero() && p.z.is_zero();
}
template <class R>
const R& coordinate(const Point3<R>& p, int axis) {
  return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}
template <class R>
Point3<R> normal(const Plane<R>& plane) {
  return {plane.a, plane.b, plane.c};
}
/// Positive above the plane, that is outside its half-space.
template <class R>
R height(const Plane<R>& plane, const Point3<R>& p) {
  return plane.a * p.x + plane.b * p.y + plane.c * p.z - plane.d;
}
template <class R>
Plane<R> plane_through(const Point3<R>& n, const Point3<R>& p) {
  return {n.x, n.y, n.z, dot(n, p)};
}

/// A polygon in space, by its corners.
template <class R>
struct PolygonView {
  const std::vector<Point3<R>>& points;
  std::span<const VertexId> loop;
  [[nodiscard]] std::size_t size() const { return loop.size(); }
  /// Corner i, counted cyclically.
  [[nodiscard]] const Point3<R>& operator[](std::size_t i) const { return points[index(loop[i % loop.size()])]; }
};

/// What is known of one facet.
template <class R>
struct FacetShape {
  std::optional<Plane<R>> plane;  ///< outward by the order of the corners; empty without an area
  std::optional<std::size_t> off_plane;      ///< a corner that is not on the plane
  std::optional<std::size_t> reflex_corner;  ///< a corner that is not strictly convex
  bool turns_once = false;                   ///< meaningful when there is no reflex corner
  [[nodiscard]] bool planar() const { return plane.has_value() && !off_plane.has_value(); }
  [[nodiscard]] bool strictly_convex() const { return planar() && !reflex_corner.has_value() && turns_once; }
};

/// Number of sign changes, going round, in a cyclic sequence whose zeros are skipped.
inline std::size_t cyclic_sign_changes(const std::vector<int>& signs) {
  std::size_t changes = 0;
  int first = 0, last = 0;
  for (const int s : signs) {
    if (s == 0) continue;
    if (first == 0) first = s;
    if (last != 0 && s != last) ++changes;
    last = s;
  }
  return changes + (first != last ? 1 : 0);
}

/// Sign of the area of the polygon seen along `axis`, counter-clockwise positive.
template <class R>
int projected_area_sign(const PolygonView<R>& polygon, int axis) {
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  R twice{};
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const Point3<R> p = polygon[i] - polygon[0], q = polygon[i + 1] - polygon[0];
    twice += coordinate(p, u) * coordinate(q, v) - coordinate(p, v) * coordinate(q, u);
  }
  return twice.sign();
}

/// Decides plane, planarity and strict convexity of a polygon of at least 3 corners.
template <class R>
FacetShape<R> facet_shape(const PolygonView<R>& polygon) {
  FacetShape<R> shape;
  const std::size_t n = polygon.size();
  Point3<R> direction{};
  for (std::size_t j = 0; j < n && is_zero(direction); ++j) {
    direction = cross(polygon[j + 1] - polygon[j], polygon[j + 2] - polygon[j + 1]);
  }
  if (is_zero(direction)) return shape;
  const int axis = !direction.x.is_zero() ? 0 : !direction.y.is_zero() ? 1 : 2;
  const int area = projected_area_sign(polygon, axis);
  // A polygon whose area vanishes along an axis that its normal has no right angle with is bent or crosses itself.
  if (area != 0 && area != coordinate(direction, axis).sign()) direction = {-direction.x, -direction.y, -direction.z};
  shape.plane = plane_through(direction, polygon[0]);
  const int facing = coordinate(direction, axis).sign();
  const int u = (axis + 1) % 3, v = (axis + 2) % 3;
  std::vector<int> steps(n);
  for (std::size_t j = 0; j < n; ++j) {
    if (!shape.off_plane && !height(*shape.plane, polygon[j]).is_zero()) shape.off_plane = j;
    const Point3<R> in = polygon[j + n] - polygon[j + n - 1], out = polygon[j + 1] - polygon[j];
    steps[j] = coordinate(out, u).sign();
    const R turn = coordinate(in, u) * coordinate(out, v) - coordinate(in, v) * coordinate(out, u);
    if (!shape.reflex_corner && turn.sign() != facing) shape.reflex_corner = j;
  }
  shape.turns_once = cyclic_sign_changes(steps) == 2;
  if (area == 0 && !shape.off_plane) shape.plane.reset();
  return shape;
}

/// Whether the facets around a vertex, all edges of which are strictly convex, form a convex cone: it is pointed
/// along −Σ normals, and the polygon in which it meets a plane across that axis goes round once.
template <class R>
bool vertex_cone_turns_once(const std::vector<Point3<R>>& directions, const std::vector<Point3<R>>& normals) {
  Point3<R> axis{};
  for (const Point3<R>& n : normals) axis = axis - n;
  const std::size_t m = directions.size();
  std::vector<R> along(m), height_over_first(m);
  for (std::size_t i = 0; i < m; ++i) {
    along[i] = dot(axis, directions[i]);
    height_over_first[i] = dot(normals[0], directions[i]);
    if (along[i].sign() <= 0) return false;
  }
  std::vector<int> steps(m);
  for (std::size_t i = 0; i < m; ++i) {
    const std::size_t j = (i + 1) % m;
    steps[i] = (height_over_first[j] * along[i] - height_over_first[i] * along[j]).sign();
  }
  return cyclic_sign_changes(steps) == 2;
}

}  // namespace hexact::detail
