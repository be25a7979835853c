// SPDX-License-Identifier: LGPL-3.0-or-later
#include "new_edges.hpp"

#include <cmath>

namespace hexact::detail {
namespace {

using Vector = Point3<double>;

Vector plus(const Vector& a, const Vector& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Vector minus(const Vector& a, const Vector& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
Vector cross(const Vector& a, const Vector& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
double dot(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
double length(const Vector& a) { return std::sqrt(dot(a, a)); }
double angle(const Vector& a, const Vector& b) { return std::atan2(length(cross(a, b)), dot(a, b)); }

/// The corner of half-edge h at its origin: facet F, G behind h, P behind the half-edge before h.
struct Corner {
  Vector f, g, p;
  double determinant = 0;  ///< of F, P, G, positive
};

Corner corner_at(const HoneycombMap& map, const RawVector<Vector>& normals, std::uint32_t h) {
  Corner c{normals[map.facet(h)], normals[map.facet(map.twin(h))], normals[map.facet(map.twin(map.previous(h)))], 0};
  c.determinant = dot(c.f, cross(c.p, c.g));
  return c;
}

/// In F, the lines of h and of the half-edge p before it move in by n_G·y = −τ_h, n_P·y = −τ_p. Their common point moves
/// along h by (τ_p |F × G| + τ_h k/|F × G|)/det, and along p by minus the same with G and P exchanged, where
/// k = (F·P)(F·G) − (F·F)(P·G).
double along_own(const Corner& c) {
  return (dot(c.f, c.p) * dot(c.f, c.g) - dot(c.f, c.f) * dot(c.p, c.g)) / c.determinant;
}

}  // namespace

NewEdges new_edges(const ChamferLevel& level, const EdgeNumbering& edges) {
  const HoneycombMap& map = level.surface.map;
  const RawVector<Vector> normals = scaled_normals(level);
  NewEdges out;
  out.sides.reserve(map.half_edge_count());
  out.spokes.reserve(map.half_edge_count());
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    const std::uint32_t before = map.previous(h), after = map.next(h);
    const Corner a = corner_at(map, normals, h), b = corner_at(map, normals, after);
    const double sine = length(cross(a.f, a.g));
    NewEdge side;
    side.length.edge = {edges.edge[before], edges.edge[h], edges.edge[after]};
    side.length.weight = {-sine / a.determinant, -(along_own(a) + along_own(b)) / sine, -sine / b.determinant};
    side.length.base = length(minus(level.surface.points[map.target(h)], level.surface.points[map.origin(h)]));
    side.angle = angle(a.f, plus(a.f, a.g));
    out.sides.push_back(side);
    // The corner where all three move in stands behind F by half the triangle defect: (2) of docs/chamfer.md.
    const Vector dual = plus(minus(cross(a.f, a.p), cross(a.f, a.g)), cross(a.g, a.p));
    const double rate = length(dual) / a.determinant / 2;
    NewEdge spoke;
    spoke.length.edge = {edges.edge[before], edges.edge[h], edges.edge[map.next(map.twin(h))]};
    spoke.length.weight = {rate, rate, -rate};
    spoke.angle = angle(plus(a.f, a.g), plus(a.f, a.p));
    out.spokes.push_back(spoke);
  }
  return out;
}

}  // namespace hexact::detail
