// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/honeycomb.hpp"

#include "homogeneous_ring.hpp"
#include "honeycomb_impl.hpp"

#include <cmath>
#include <limits>
#include <optional>
#include <string>

// Planes in file coordinates, and steps whose cut planes are chosen freely: admissible iff exact signs of the
// result say so, phs (d.1, last part).
namespace hexact::detail {

/// n·x_file <= 2^scale·d + n·shift.
template <class S>
Plane<S> in_file_coordinates(const Plane<S>& p, const PlaneBody& body) {
  const S unit(Rational(1).scaled(body.scale));
  return {p.a, p.b, p.c, p.d * unit + p.a * S(body.shift[0]) + p.b * S(body.shift[1]) + p.c * S(body.shift[2])};
}

inline std::vector<Plane<Rational>> file_planes(const PlaneBody& body, const Rational*) {
  if (body.field != Field::rational) {
    throw InvalidInput("FieldNotRational", "the body lies in Q(sqrt5): use arithmetic in Q(sqrt5)", "");
  }
  std::vector<Plane<Rational>> out;
  for (std::size_t f = 0; f < body.planes.size(); ++f) {
    const Plane<Integer> p = body.planes[f];
    out.push_back(canonical(to_ring(in_file_coordinates<Rational>({p.a, p.b, p.c, p.d}, body))));
  }
  return out;
}

inline std::vector<Plane<QuadraticField>> file_planes(const PlaneBody& body, const QuadraticField*) {
  std::vector<Plane<QuadraticField>> out;
  if (body.field == Field::sqrt5) {
    for (const auto& p : body.planes_sqrt5) out.push_back(canonical(to_ring(in_file_coordinates(p, body))));
    return out;
  }
  for (const Plane<Rational>& p : file_planes(body, static_cast<const Rational*>(nullptr))) {
    out.push_back({p.a, p.b, p.c, p.d});
  }
  return out;
}

inline void store_planes(const std::vector<Plane<Rational>>& planes, PlaneBody& body) {
  body.field = Field::rational;
  body.planes.reserve(planes.size());
  for (const auto& p : planes) body.planes.push_back(to_ring(p));
}

inline void store_planes(const std::vector<Plane<QuadraticField>>& planes, PlaneBody& body) {
  body.field = Field::sqrt5;
  body.planes_sqrt5 = planes;
}

template <class S>
std::array<double, 3> unit_normal(const Plane<S>& p) {
  const auto magnitude = [](const S& x) { return hexact::sign(x) < 0 ? -x : x; };
  const S sum = magnitude(p.a) + magnitude(p.b) + magnitude(p.c);  // brings wide coefficients into range
  const double x = (p.a / sum).to_double(), y = (p.b / sum).to_double(), z = (p.c / sum).to_double();
  const double length = std::sqrt(x * x + y * y + z * z);
  return {x / length, y / length, z / length};
}

/// The proposed plane with a normal of 31 bits and an offset rounded outward: a margin of 2^-50 is above the
/// rounding of a support function of few operations.
template <class S>
Plane<S> rounded_outward(const PlanePolicy& policy, const CornerView& view) {
  const std::array<double, 3> wanted = policy.normal(view);
  const double length = std::sqrt(wanted[0] * wanted[0] + wanted[1] * wanted[1] + wanted[2] * wanted[2]);
  if (!(length > 0) || !std::isfinite(length)) throw NumericalFailure("a cut policy proposed a plane without a normal");
  std::array<double, 3> n;
  for (std::size_t k = 0; k < 3; ++k) n[k] = std::nearbyint(wanted[k] * (0x1p30 / length));
  const double d = policy.offset(n);
  if (!std::isfinite(d)) throw NumericalFailure("a cut policy proposed a plane without a finite offset");
  const Rational offset = Rational::from_double(std::nextafter(d + std::fabs(d) * 0x1p-50, std::numeric_limits<double>::infinity()));
  const Plane<Rational> plane = canonical(to_ring(
      Plane<Rational>{Rational::from_double(n[0]), Rational::from_double(n[1]), Rational::from_double(n[2]), offset}));
  return {S(plane.a), S(plane.b), S(plane.c), S(plane.d)};
}

inline InvalidInput lattice_lost(std::uint32_t level, const std::string& what, const std::string& element) {
  return InvalidInput("LatticeLost", what + " at level " + std::to_string(level), element);
}

/// A facet turns once: along an axis its normal is not parallel to, the direction of travel changes sign twice.
template <class S>
bool turns_once(const HoneycombLevel<S>& level, std::uint32_t f) {
  const bool along_x = !level.planes[f].b.is_zero() || !level.planes[f].c.is_zero();
  const auto coordinate = [&](std::uint32_t v) -> const S& { return along_x ? level.points[v].x : level.points[v].y; };
  std::vector<int> directions;
  const std::uint32_t start = level.map.facet_start(f);
  for (std::uint32_t i = 0; i < level.map.facet_size(f); ++i) {
    const S step = coordinate(level.map.target(start + i)) - coordinate(level.map.origin(start + i));
    if (const int s = hexact::sign(step); s != 0) directions.push_back(s);
  }
  int changes = 0;
  for (std::size_t i = 0; i < directions.size(); ++i) changes += directions[i] != directions[(i + 1) % directions.size()];
  return changes == 2;
}

/// Throws LatticeLost unless the result is locally strictly convex everywhere: with a connected closed map of
/// Euler characteristic 2 it then bounds a convex body (van Heijenoort 1952) with the lattice of phs (b.2).
template <class S>
void require_convex(const HoneycombLevel<S>& level, const HoneycombMap& old) {
  const auto planes = ring_planes(level.planes);
  const auto points = ring_points(level.points);
  const HoneycombMap& map = level.map;
  // Vertex v of this level lies on half-edge v of the old one.
  for (std::uint32_t v = 0; v < map.vertex_count(); ++v) {
    const auto f = map.facets_at(v);
    if (sign(normal_determinant(planes[f[0]], planes[f[1]], planes[f[2]])) <= 0) {
      throw lattice_lost(map.level(), "the planes beside it do not meet in a convex corner", edge_name(old, v));
    }
  }
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    const std::uint32_t far = map.target(map.next(map.twin(h)));
    if (sign(height(planes[map.facet(h)], points[far])) >= 0) {
      throw lattice_lost(map.level(), "the cuts at its ends leave nothing of an edge between them",
                         edge_name(old, map.origin(h)));
    }
  }
  for (std::uint32_t f = 0; f < map.facet_count(); ++f) {
    if (!turns_once(level, f)) throw lattice_lost(map.level(), "is not a simple polygon", "facet " + std::to_string(f));
  }
}

/// The λ that the planes realise on each half-edge, by the heights of its two ends over the plane of the first.
/// Empty where an edge is parallel to such a plane: it has no cut point there.
template <class S>
std::optional<std::vector<S>> realised_parameters(const HoneycombLevel<S>& level, const std::vector<Plane<S>>& planes) {
  const HoneycombMap& map = level.map;
  const std::size_t old = map.facet_count();
  std::vector<S> lambda;
  lambda.reserve(map.half_edge_count());
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    const Plane<S>& p = planes[old + map.origin(h)];
    const auto above = [&](const Point3<S>& x) { return p.a * x.x + p.b * x.y + p.c * x.z - p.d; };
    const S at_b = above(level.points[map.target(h)]);
    const S fall = above(level.points[map.origin(h)]) - at_b;
    if (fall.is_zero()) return std::nullopt;
    lambda.push_back(-at_b / fall);
  }
  return lambda;
}

template <class S>
HoneycombStep<S> step_by_planes(const HoneycombLevel<S>& level, const PlanePolicy& policy) {
  const HoneycombMap& map = level.map;
  std::vector<Plane<S>> planes = level.planes;
  planes.resize(map.facet_count() + map.vertex_count());
  for_each_index(map.vertex_count(), [&](std::uint32_t v) {
    CornerView view;
    const auto f = map.facets_at(v);
    for (std::size_t k = 0; k < 3; ++k) view.unit_normals[k] = unit_normal(level.planes[f[k]]);
    const Point3<S>& p = level.points[v];
    view.point = {p.x.to_double(), p.y.to_double(), p.z.to_double()};
    view.level = map.level();
    planes[map.facet_count() + v] = rounded_outward<S>(policy, view);
  });
  for (std::uint32_t v = 0; v < map.vertex_count(); ++v) {
    if (sign(height(to_ring(planes[map.facet_count() + v]), to_ring(level.points[v]))) <= 0) {
      throw lattice_lost(map.level() + 1, "is not strictly beyond its own plane", "vertex " + std::to_string(v));
    }
  }
  std::vector<Point3<S>> points = new_points(map, planes);
  HoneycombStep<S> step{{map.refined(), std::move(planes), std::move(points)}, {S(0), S(0)}};
  require_convex(step.level, map);
  if (const auto lambda = realised_parameters(level, step.level.planes)) {
    step.figures = {smallest_delta(map, *lambda),
                    smallest_gap(map, cut_points(map, ring_points(level.points), *lambda), step.level.points)};
  }
  return step;
}

}  // namespace hexact::detail
