// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

// Measures of a surface of facets given by a map with half-edges; instantiated for each kind of map.

#include "hexact/kernel/errors.hpp"
#include "hexact/kernel/honeycomb_statistics.hpp"
#include "hexact/kernel/mesh_topology.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace hexact::surface {

using Range = tbb::blocked_range<std::uint32_t>;
using Vector = Point3<double>;
constexpr std::size_t kGrain = 1 << 13;
constexpr double kNoAngle = -1;  ///< of a boundary edge

inline Vector minus(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
inline Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// Squares in this range have lost nothing to overflow or underflow.
constexpr double kLeastSquare = 1e-200, kGreatestSquare = 1e200;
inline bool trusted(double square) { return square >= kLeastSquare && square <= kGreatestSquare; }
inline double length(const Vector& a) {
  const double square = dot(a, a);
  // Not hypot of three, which some libraries make NaN of infinities.
  return trusted(square) ? std::sqrt(square) : std::hypot(std::hypot(a.x, a.y), a.z);
}

struct Extremes {
  double angle = 0, longest = 0, shortest = std::numeric_limits<double>::infinity();
};

/// Angle between unit vectors, accurate for small ones.
inline double angle_between(const Vector& a, const Vector& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

template <class Map>
double diameter(const Map& map, std::span<const Vector> points, std::uint32_t f) {
  const std::uint32_t start = map.facet_start(f), end = start + map.facet_size(f);
  double squared = 0, largest = 0;
  for (std::uint32_t i = start; i < end; ++i) {
    for (std::uint32_t j = i + 1; j < end; ++j) {
      const Vector d = minus(points[map.origin(i)], points[map.origin(j)]);
      squared = std::max(squared, dot(d, d));
      if (!trusted(squared)) largest = std::max(largest, length(d));
    }
  }
  return trusted(squared) ? std::sqrt(squared) : largest;
}

template <class Map>
double largest_diameter(const Map& map, std::span<const Vector> points) {
  return tbb::parallel_deterministic_reduce(
      Range(0, static_cast<std::uint32_t>(map.facet_count()), kGrain), 0.0,
      [&](const Range& range, double largest) {
        for (std::uint32_t f = range.begin(); f != range.end(); ++f) largest = std::max(largest, diameter(map, points, f));
        return largest;
      },
      [](double a, double b) { return std::max(a, b); });
}


template <class Map>
HoneycombStatistics measure(const Map& map, std::span<const Point3<double>> points,
                            std::span<const Point3<double>> unit_normals) {
  HEXACT_EXPECTS(points.size() == map.vertex_count() && unit_normals.size() == map.facet_count());
  // Both half-edges of an inner edge get its angle: the median over half-edges is that over edges.
  std::vector<double> angles(map.half_edge_count());
  const Extremes found = tbb::parallel_deterministic_reduce(
      Range(0, static_cast<std::uint32_t>(map.half_edge_count()), kGrain), Extremes{},
      [&](const Range& range, Extremes e) {
        for (std::uint32_t h = range.begin(); h != range.end(); ++h) {
          const std::uint32_t twin = map.twin(h);
          const bool inner = twin != kNoTwin;
          const double angle = inner ? angle_between(unit_normals[map.facet(h)], unit_normals[map.facet(twin)]) : 0;
          angles[h] = inner ? angle : kNoAngle;
          if (h > twin) continue;
          const double edge = length(minus(points[map.origin(h)], points[map.target(h)]));
          e = {std::max(e.angle, angle), std::max(e.longest, edge), std::min(e.shortest, edge)};
        }
        return e;
      },
      [](const Extremes& a, const Extremes& b) {
        return Extremes{std::max(a.angle, b.angle), std::max(a.longest, b.longest), std::min(a.shortest, b.shortest)};
      });
  std::erase(angles, kNoAngle);
  double median = 0;
  if (!angles.empty()) {
    const auto middle = angles.begin() + static_cast<std::ptrdiff_t>((angles.size() - 1) / 2);
    std::nth_element(angles.begin(), middle, angles.end());
    median = *middle;
  }
  constexpr double kDegrees = 180 / std::numbers::pi;
  return {found.angle * kDegrees, median * kDegrees, found.longest, found.shortest,
          largest_diameter(map, points)};
}

/// Newell's sum over the fan from the first corner; `corner(i)` is corner i < k.
template <class Corner>
Vector newell_sum(std::uint32_t k, const Corner& corner) {
  const Vector p = corner(0);
  Vector sum{0, 0, 0};
  for (std::uint32_t i = 1; i + 1 < k; ++i) {
    const Vector n = cross(minus(corner(i), p), minus(corner(i + 1), p));
    sum = {sum.x + n.x, sum.y + n.y, sum.z + n.z};
  }
  return sum;
}

/// The same in units of the facet's extent, a power of two: very large and very small facets have normals too.
template <class Corner>
Vector scaled_newell_sum(std::uint32_t k, const Corner& corner) {
  for (const double factor : {1.0, 0.5}) {  // differences of the largest doubles overflow
    const auto difference = [&](std::uint32_t i) {
      const Vector p = corner(i), q = corner(0);
      return minus({factor * p.x, factor * p.y, factor * p.z}, {factor * q.x, factor * q.y, factor * q.z});
    };
    double extent = 0;
    bool finite = true;
    for (std::uint32_t i = 1; i < k; ++i) {
      const Vector d = difference(i);
      for (const double x : {d.x, d.y, d.z}) {
        finite = finite && std::isfinite(x);
        extent = std::max(extent, std::abs(x));
      }
    }
    if (!finite) continue;
    if (extent == 0) break;
    const int exponent = std::ilogb(extent) + 1;
    return newell_sum(k, [&](std::uint32_t i) {
      const Vector d = difference(i);
      return Vector{std::ldexp(d.x, -exponent), std::ldexp(d.y, -exponent), std::ldexp(d.z, -exponent)};
    });
  }
  return {0, 0, 0};
}

template <class Map>
std::vector<Point3<double>> newell_normals(const Map& map, std::span<const Point3<double>> points) {
  std::vector<Vector> normals(map.facet_count());
  tbb::parallel_for(Range(0, static_cast<std::uint32_t>(map.facet_count()), kGrain), [&](const Range& range) {
    for (std::uint32_t f = range.begin(); f != range.end(); ++f) {
      const std::uint32_t start = map.facet_start(f), k = map.facet_size(f);
      const auto corner = [&](std::uint32_t i) { return points[map.origin(start + i)]; };
      Vector sum = newell_sum(k, corner);
      if (!trusted(dot(sum, sum))) sum = scaled_newell_sum(k, corner);
      const double l = length(sum);
      normals[f] = l > 0 ? Vector{sum.x / l, sum.y / l, sum.z / l} : Vector{0, 0, 0};
    }
  });
  return normals;
}

}  // namespace hexact::surface
