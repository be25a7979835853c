// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/certify.hpp"
#include "hexact/exact/plane_body.hpp"

#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <stdexcept>
#include <utility>
#include <vector>

// Chamfers for tests, made from lists alone: a second route to what the library's engine makes.
namespace hexact::samples {

/// The body with planes multiplied by integers, so that all normals have a length near 2^bits. Rational bodies only.
inline PlaneBody with_equal_normals(PlaneBody body, int bits) {
  for (std::size_t i = 0; i < body.planes.size(); ++i) {
    const Plane<Integer> p = body.planes[i];
    const double length = std::hypot(p.a.to_double(), p.b.to_double(), p.c.to_double());
    const Integer k(static_cast<long long>(std::max(1.0, std::round(std::ldexp(1.0, bits) / length))));
    body.planes.set(i, Plane<Integer>{p.a * k, p.b * k, p.c * k, p.d * k});
  }
  return body;
}

/// One chamfer step with the plane F + G − lift(e, f, g) for edge e between facets f and g; old planes are doubled. Whether the result is convex
/// depends on the lifts. Edges are numbered in the order in which the loops first take them to the larger vertex.
template <class Lift>
PlaneBody chamfer_step(const PlaneBody& body, std::uint32_t level, const Lift& lift) {
  using Edge = std::pair<std::size_t, std::size_t>;
  std::map<Edge, std::size_t> half_edge;  // (from, to) → number
  std::vector<Edge> edges;
  std::vector<std::size_t> facet;
  std::vector<Edge> of;
  for (std::size_t f = 0; f < body.loops.size(); ++f) {
    const auto loop = body.loops[f];
    for (std::size_t j = 0; j < loop.size(); ++j) {
      const Edge e{index(loop[j]), index(loop[(j + 1) % loop.size()])};
      half_edge[e] = of.size();
      of.push_back(e);
      facet.push_back(f);
      if (e.first < e.second) edges.push_back(e);
    }
  }
  const auto next = [&](std::size_t h) {
    const auto loop = body.loops[facet[h]];
    const std::size_t start = body.loops.start(facet[h]);
    return start + (h - start + 1) % loop.size();
  };
  PlaneBody out;
  out.scale = body.scale, out.shift = body.shift, out.addresses = body.addresses;
  std::map<Edge, std::size_t> plane;
  for (std::size_t i = 0; i < body.planes.size(); ++i) {
    const Plane<Integer> p = body.planes[i];
    out.planes.push_back(Plane<Integer>{p.a + p.a, p.b + p.b, p.c + p.c, p.d + p.d});
    std::vector<VertexId> loop;
    for (std::size_t j = 0; j < body.loops[i].size(); ++j) loop.push_back(make_id<VertexId>(body.loops.start(i) + j));
    out.loops.add(loop);
  }
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const auto [a, b] = edges[e];
    const std::size_t h = half_edge.at({a, b}), g = half_edge.at({b, a});
    const Plane<Integer> f = body.planes[facet[h]], k = body.planes[facet[g]];
    plane[{a, b}] = plane[{b, a}] = out.planes.size();
    out.planes.push_back(Plane<Integer>{f.a + k.a, f.b + k.b, f.c + k.c, f.d + k.d - lift(e, facet[h], facet[g])});
    out.addresses.push_back({level, make_id<VertexId>(e)});
    std::vector<VertexId> loop;
    for (const std::size_t v : {of.size() + a, next(g), g, of.size() + b, next(h), h}) loop.push_back(make_id<VertexId>(v));
    out.loops.add(loop);
  }
  const auto id = [](std::size_t f) { return make_id<FacetId>(f); };
  for (std::size_t h = 0; h < of.size(); ++h) {
    const Edge before = of[body.loops.start(facet[h]) + (h - body.loops.start(facet[h]) + body.loops[facet[h]].size() - 1) %
                                                            body.loops[facet[h]].size()];
    out.triples.push_back({id(facet[h]), id(plane.at(before)), id(plane.at(of[h]))});
  }
  std::vector<std::vector<std::size_t>> around(body.vertex_count());
  for (const auto& [edge, p] : plane) around[edge.first].push_back(p);
  for (const auto& t : around) out.triples.push_back({id(t.at(0)), id(t.at(1)), id(t.at(2))});
  return out;
}

/// `levels` chamfer steps whose lifts are uneven by up to a quarter, each as large as a power of two allows.
inline PlaneBody chamfer(PlaneBody body, std::uint32_t levels, std::uint32_t first_level = 1, int bits = 12) {
  body = with_equal_normals(std::move(body), bits);
  for (std::uint32_t l = first_level; l < first_level + levels; ++l) {
    for (unsigned long size = static_cast<unsigned long>(bits + 40);; --size) {
      if (size < 3) throw std::logic_error("no lift of this sample is small enough");
      const auto lift = [&](std::size_t e, std::size_t, std::size_t) { return Integer(static_cast<long long>(8 + e % 3)) * Integer::power_of_two(size - 3); };
      PlaneBody next = chamfer_step(body, l, lift);
      if (overall(verify(make_certificate(next, {{"convex", ""}}, {}, {}))) != Verdict::proved) continue;
      body = std::move(next);
      break;
    }
  }
  return body;
}

/// Two steps. The first lifts of the three edges at each vertex of the facets `caps`, which share no vertex, are 55, 55
/// and 100, so that the defect of these facets is 10; the second step lifts the edges of these facets by `lift`.
inline PlaneBody narrow_budget(const PlaneBody& base, const std::set<std::size_t>& caps, long long lift) {
  const long long unit = 1 << 8;
  const auto is_cap = [&](std::size_t f) { return caps.count(f) != 0; };
  std::set<std::size_t> beside_cap;
  const PlaneBody one = chamfer_step(with_equal_normals(base, 20), 1, [&](std::size_t e, std::size_t f, std::size_t g) {
    if (!is_cap(f) && !is_cap(g)) return Integer(100 * unit);
    beside_cap.insert(base.plane_count() + e);
    return Integer(55 * unit);
  });
  return chamfer_step(one, 2, [&](std::size_t, std::size_t f, std::size_t g) {
    if (is_cap(f) || is_cap(g)) return Integer(lift * unit);
    return Integer((beside_cap.count(f) != 0 && beside_cap.count(g) != 0 ? 14 : 8) * unit);
  });
}

}  // namespace hexact::samples
