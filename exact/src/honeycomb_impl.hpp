// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/honeycomb.hpp"

#include "homogeneous_ring.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <string>

namespace hexact::detail {

inline Rational parameter_in(const QuadraticField& x, const Rational*) {
  if (!x.is_rational()) {
    throw InvalidInput("FieldNotRational", "the parameter " + x.str() + " needs arithmetic in Q(sqrt5)", "");
  }
  return x.rational_part();
}
inline QuadraticField parameter_in(const QuadraticField& x, const QuadraticField*) { return x; }

template <class F>
void for_each_index(std::size_t count, const F& work, const ProgressPart& progress = {}) {
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, static_cast<std::uint32_t>(count), 16), [&](const auto& range) {
    progress.check();
    for (std::uint32_t i = range.begin(); i != range.end(); ++i) work(i);
  });
}

/// λ of every half-edge.
template <class S>
std::vector<S> asked_parameters(const HoneycombMap& map, const CutPolicy& policy) {
  std::vector<S> out(map.half_edge_count());
  for_each_index(out.size(), [&](std::uint32_t h) {
    out[h] = parameter_in(asked_parameter(map, policy, h), static_cast<const S*>(nullptr));
  });
  return out;
}

template <class S>
std::vector<Plane<Ring<S>>> ring_planes(const std::vector<Plane<S>>& planes) {
  std::vector<Plane<Ring<S>>> out(planes.size());
  for_each_index(planes.size(), [&](std::uint32_t f) { out[f] = to_ring(planes[f]); });
  return out;
}

template <class S>
std::vector<RingPoint<Ring<S>>> ring_points(const std::vector<Point3<S>>& points) {
  std::vector<RingPoint<Ring<S>>> out(points.size());
  for_each_index(points.size(), [&](std::uint32_t v) { out[v] = to_ring(points[v]); });
  return out;
}

/// The point of three planes. `defect` names what it would have been.
template <class S>
Point3<S> meet_in(const Plane<Ring<S>>& p, const Plane<Ring<S>>& q, const Plane<Ring<S>>& r, const char* code,
                  const std::string& element) {
  using R = Ring<S>;
  const auto cross = [](const Plane<R>& u, const Plane<R>& v) {
    return std::array<R, 3>{u.b * v.c - u.c * v.b, u.c * v.a - u.a * v.c, u.a * v.b - u.b * v.a};
  };
  const auto qr = cross(q, r), rp = cross(r, p), pq = cross(p, q);
  const R w = p.a * qr[0] + p.b * qr[1] + p.c * qr[2];
  if (w.is_zero()) throw InvalidInput(code, "the normals of its three planes are dependent", element);
  const auto coordinate = [&](std::size_t k) { return ratio(p.d * qr[k] + q.d * rp[k] + r.d * pq[k], w); };
  return {coordinate(0), coordinate(1), coordinate(2)};
}

inline std::string edge_name(const HoneycombMap& map, std::uint32_t h) {
  const std::uint32_t a = map.origin(h), b = map.target(h);
  return "edge " + std::to_string(std::min(a, b)) + "-" + std::to_string(std::max(a, b));
}

/// The new vertices: facet(h) ∩ H_origin ∩ H_target for each half-edge h, phs (h.1).
template <class S>
std::vector<Point3<S>> new_points(const HoneycombMap& map, const std::vector<Plane<S>>& planes,
                                  const ProgressPart& progress = {}) {
  const auto ring = ring_planes(planes);
  const std::size_t old = map.facet_count();
  std::vector<Point3<S>> out(map.half_edge_count());
  for_each_index(out.size(), [&](std::uint32_t h) {
    out[h] = meet_in<S>(ring[map.facet(h)], ring[old + map.origin(h)], ring[old + map.target(h)], "LatticeLost",
                        edge_name(map, h));
  }, progress);
  return out;
}

/// The cut points E(a→b) of all half-edges.
template <class S>
std::vector<RingPoint<Ring<S>>> cut_points(const HoneycombMap& map, const std::vector<RingPoint<Ring<S>>>& vertices,
                                           const std::vector<S>& lambda) {
  std::vector<RingPoint<Ring<S>>> out(map.half_edge_count());
  for_each_index(out.size(), [&](std::uint32_t h) {
    const Integer q = common_denominator(Integer(1), lambda[h]);
    out[h] = cut_point(times(lambda[h], q), q, vertices[map.origin(h)], vertices[map.target(h)]);
  });
  return out;
}

/// Cut points of every half-edge, and the cut planes through them.
template <class S>
struct Cuts {
  std::vector<RingPoint<Ring<S>>> points;
  std::vector<Plane<S>> planes;
};

template <class S>
Cuts<S> cuts_by_parameters(const HoneycombLevel<S>& level, const std::vector<S>& lambda, const ProgressPart& progress) {
  const HoneycombMap& map = level.map;
  const auto vertices = ring_points(level.points);
  Cuts<S> cuts;
  cuts.points = cut_points(map, vertices, lambda);
  cuts.planes.resize(map.vertex_count());
  for_each_index(map.vertex_count(), [&](std::uint32_t v) {
    const auto s = map.star(v);
    cuts.planes[v] = canonical(
        plane_through<Ring<S>>({cuts.points[s[0]], cuts.points[s[1]], cuts.points[s[2]]}, vertices[v], v));
  }, progress);
  return cuts;
}

template <class S>
S minimum(const std::vector<S>& values) {
  HEXACT_EXPECTS(!values.empty());
  const S* least = &values[0];
  for (const S& x : values) {
    if (x < *least) least = &x;
  }
  return *least;
}

template <class S>
S smallest_delta(const HoneycombMap& map, const std::vector<S>& lambda) {
  std::vector<S> deltas;
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    if (h < map.twin(h)) deltas.push_back(S(1) - lambda[h] - lambda[map.twin(h)]);
  }
  return minimum(deltas);
}

/// 1 − v_j − u_{j+1} at the corner where h leaves: q_{j+1} − q_j over E_{j+2,j+1} − E_{j,j+1} on the cut segment
/// of the corner (phs b.3, 1).
template <class S>
S corner_gap(const HoneycombMap& map, std::uint32_t h, const std::vector<RingPoint<Ring<S>>>& cuts,
             const std::vector<Point3<S>>& fresh) {
  const std::uint32_t before = map.previous(h);
  const auto &e = cuts[h], &f = cuts[map.twin(before)];
  const auto share = [&](const Ring<S>& x, const Ring<S>& y, const S& numerator) {
    return numerator / (ratio(x, Ring<S>(e.w)) - ratio(y, Ring<S>(f.w)));
  };
  const auto differ = [&](const Ring<S>& x, const Ring<S>& y) {
    return !(x * Ring<S>(f.w) - y * Ring<S>(e.w)).is_zero();
  };
  const Point3<S>&q = fresh[h], &p = fresh[before];
  if (differ(e.x, f.x)) return share(e.x, f.x, q.x - p.x);
  if (differ(e.y, f.y)) return share(e.y, f.y, q.y - p.y);
  HEXACT_INVARIANT(differ(e.z, f.z));
  return share(e.z, f.z, q.z - p.z);
}

template <class S>
S smallest_gap(const HoneycombMap& map, const std::vector<RingPoint<Ring<S>>>& cuts, const std::vector<Point3<S>>& fresh,
               const ProgressPart& progress = {}) {
  std::vector<S> gaps(fresh.size());
  for_each_index(gaps.size(), [&](std::uint32_t h) { gaps[h] = corner_gap(map, h, cuts, fresh); }, progress);
  return minimum(gaps);
}

template <class S>
HoneycombStep<S> step_by_parameters(const HoneycombLevel<S>& level, const CutPolicy& policy, const ProgressPart& progress) {
  if (auto findings = condition_violations(level.map, policy); !findings.empty()) throw InvalidInput(std::move(findings));
  const std::vector<S> lambda = asked_parameters<S>(level.map, policy);
  const Cuts<S> cuts = cuts_by_parameters(level, lambda, progress);
  progress.report(0.4);
  std::vector<Plane<S>> planes = level.planes;
  planes.insert(planes.end(), cuts.planes.begin(), cuts.planes.end());
  std::vector<Point3<S>> points = new_points(level.map, planes, progress);
  progress.report(0.8);
  StepFigures<S> figures{smallest_delta(level.map, lambda), smallest_gap(level.map, cuts.points, points, progress)};
  progress.report(1);
  return {{level.map.refined(), std::move(planes), std::move(points)}, std::move(figures)};
}

}  // namespace hexact::detail
