// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/volume.hpp"

#include <vector>

namespace hexact {
namespace {

template <class S>
S determinant(const Point3<S>& p, const Point3<S>& q, const Point3<S>& r) {
  return p.x * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) + p.z * (q.x * r.y - q.y * r.x);
}

template <class S>
S balanced_sum(std::vector<S> terms) {
  if (terms.empty()) return S(0);
  while (terms.size() > 1) {
    const std::size_t half = (terms.size() + 1) / 2;
    for (std::size_t i = 0; i + half < terms.size(); ++i) terms[i] = terms[2 * i] + terms[2 * i + 1];
    if (terms.size() % 2 == 1) terms[half - 1] = terms.back();
    terms.resize(half);
  }
  return terms[0];
}

template <class S>
S volume_of(std::span<const Point3<S>> points, const FacetLoops& loops) {
  std::vector<S> terms;
  terms.reserve(loops.size());
  for (std::size_t f = 0; f < loops.size(); ++f) {
    const auto loop = loops[f];
    if (loop.empty()) continue;
    S sum(0);
    for (std::size_t i = 1; i + 1 < loop.size(); ++i) {
      sum += determinant(points[index(loop[0])], points[index(loop[i])], points[index(loop[i + 1])]);
    }
    terms.push_back(std::move(sum));
  }
  return balanced_sum(std::move(terms)) / S(6);
}

}  // namespace

Rational exact_volume(std::span<const Point3<Rational>> points, const FacetLoops& loops) {
  return volume_of(points, loops);
}

QuadraticField exact_volume(std::span<const Point3<QuadraticField>> points, const FacetLoops& loops) {
  return volume_of(points, loops);
}

QuadraticField exact_volume(const PlaneBody& body) {
  if (body.field == Field::rational) {
    std::vector<Point3<Rational>> points;
    points.reserve(body.vertex_count());
    for (std::size_t v = 0; v < body.vertex_count(); ++v) points.push_back(rational_vertex(body, make_id<VertexId>(v)));
    return exact_volume(std::span<const Point3<Rational>>(points), body.loops);
  }
  std::vector<Point3<QuadraticField>> points;
  points.reserve(body.vertex_count());
  for (std::size_t v = 0; v < body.vertex_count(); ++v) points.push_back(sqrt5_vertex(body, make_id<VertexId>(v)));
  return exact_volume(std::span<const Point3<QuadraticField>>(points), body.loops);
}

}  // namespace hexact
