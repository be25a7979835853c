// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/kernel/honeycomb_double.hpp"

#include "hexact/kernel/errors.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

namespace hexact {
namespace {

using Vector = Point3<double>;

Vector minus(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

/// λ·a + (1 − λ)·b; exactly b for λ = 0.
Vector mix(double lambda, const Vector& a, const Vector& b) {
  if (lambda == 0) return b;
  const double rest = 1 - lambda;
  return {lambda * a.x + rest * b.x, lambda * a.y + rest * b.y, lambda * a.z + rest * b.z};
}

double parameter(const SizeTable& table, const HoneycombMap& map, std::uint32_t h) {
  const std::size_t size = std::min(map.facet_size(map.facet(h)), map.facet_size(map.facet(map.twin(h))));
  return table[std::min(size, table.size() - 1)];
}

double parameter(const DoubleParameter& function, const HoneycombMap& map, std::uint32_t h) {
  return function(map, make_id<HalfEdgeId>(h));
}

/// The three new vertices on the half-edges that leave v.
template <class Parameters>
void cut_corner(const DoubleLevel& level, const Parameters& parameters, std::uint32_t v, RawVector<Vector>& out) {
  const HoneycombMap& map = level.map;
  const RawVector<Vector>& p = level.points;
  const auto star = map.star(v);
  std::array<std::uint32_t, 3> w;
  std::array<Vector, 3> cut;
  for (std::size_t i = 0; i < 3; ++i) {
    w[i] = map.target(star[i]);
    cut[i] = mix(parameter(parameters, map, star[i]), p[v], p[w[i]]);
  }
  const Vector normal = cross(minus(cut[1], cut[0]), minus(cut[2], cut[0]));
  for (std::size_t i = 0; i < 3; ++i) {
    const std::uint32_t onward = map.next(star[i]);
    const Vector near = mix(parameter(parameters, map, map.twin(star[i])), p[w[i]], p[v]);
    const Vector far = mix(parameter(parameters, map, onward), p[w[i]], p[map.target(onward)]);
    const Vector line = minus(far, near);
    const double t = dot(minus(cut[0], near), normal) / dot(line, normal);
    out[star[i]] = {near.x + t * line.x, near.y + t * line.y, near.z + t * line.z};
  }
}

template <class Parameters>
RawVector<Vector> new_points(const DoubleLevel& level, const Parameters& parameters) {
  RawVector<Vector> points(level.map.half_edge_count());
  using Range = tbb::blocked_range<std::uint32_t>;
  tbb::parallel_for(Range(0, static_cast<std::uint32_t>(level.map.vertex_count()), 1 << 13), [&](const Range& range) {
    for (std::uint32_t v = range.begin(); v != range.end(); ++v) cut_corner(level, parameters, v, points);
  });
  return points;
}

}  // namespace

DoubleLevel double_step(DoubleLevel level, const std::variant<SizeTable, DoubleParameter>& parameters) {
  HEXACT_EXPECTS(level.points.size() == level.map.vertex_count());
  if (const auto* table = std::get_if<SizeTable>(&parameters)) HEXACT_EXPECTS(!table->empty());
  RawVector<Vector> points = std::visit([&](const auto& p) { return new_points(level, p); }, parameters);
  level.points = {};
  return {level.map.refined(), std::move(points)};
}

}  // namespace hexact
