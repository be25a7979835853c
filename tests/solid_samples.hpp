// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/cut_policy.hpp"
#include "hexact/exact/plane_body.hpp"
#include "hexact/exact/snapped_honeycomb.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <utility>
#include <vector>

// Small convex bodies for tests, made from their planes alone by trying all triples.
namespace hexact::samples {

using Row = std::array<long long, 4>;

inline Plane<Integer> to_plane(const Row& r) { return {Integer(r[0]), Integer(r[1]), Integer(r[2]), Integer(r[3])}; }

inline Integer det(const Plane<Integer>& p, const Plane<Integer>& q, const Plane<Integer>& r) {
  return p.a * (q.b * r.c - q.c * r.b) - p.b * (q.a * r.c - q.c * r.a) + p.c * (q.a * r.b - q.b * r.a);
}

/// Sign of n·x − d of plane s at the point of p, q, r; det(p, q, r) != 0.
inline int side(const Plane<Integer>& s, const Plane<Integer>& p, const Plane<Integer>& q, const Plane<Integer>& r) {
  const Integer w = det(p, q, r);
  const auto minor = [&](auto column) {
    Plane<Integer> u = p, v = q, t = r;
    column(u) = p.d, column(v) = q.d, column(t) = r.d;
    return det(u, v, t);
  };
  const Integer x = minor([](Plane<Integer>& k) -> Integer& { return k.a; });
  const Integer y = minor([](Plane<Integer>& k) -> Integer& { return k.b; });
  const Integer z = minor([](Plane<Integer>& k) -> Integer& { return k.c; });
  return (s.a * x + s.b * y + s.c * z - s.d * w).sign() * w.sign();
}

/// The bounded simple polytope of the half-spaces; every plane must carry a facet.
inline PlaneBody simple_body(const std::vector<Row>& rows) {
  PlaneBody body;
  std::vector<Plane<Integer>> planes;
  for (const Row& r : rows) planes.push_back(to_plane(r));
  const std::size_t n = planes.size();
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      for (std::size_t k = j + 1; k < n; ++k) {
        const int turn = det(planes[i], planes[j], planes[k]).sign();
        if (turn == 0) continue;
        if (std::any_of(planes.begin(), planes.end(),
                        [&](const auto& s) { return side(s, planes[i], planes[j], planes[k]) > 0; })) {
          continue;
        }
        const auto f = [](std::size_t x) { return make_id<FacetId>(x); };
        // Facets counter-clockwise around the vertex.
        if (turn > 0) body.triples.push_back({f(i), f(j), f(k)});
        if (turn < 0) body.triples.push_back({f(i), f(k), f(j)});
      }
    }
  }
  const auto find_with = [&](FacetId f, FacetId g, std::size_t slot_shift) {
    for (std::size_t v = 0; v < body.triples.size(); ++v) {
      for (std::size_t s = 0; s < 3; ++s) {
        if (body.triples[v][s] == f && body.triples[v][(s + slot_shift) % 3] == g) return v;
      }
    }
    throw std::logic_error("not a simple polytope");
  };
  for (std::size_t i = 0; i < n; ++i) {
    const FacetId f = make_id<FacetId>(i);
    // Around facet f: the vertex (f, g, h) is followed by the one where h takes the place of g: the loop runs along h.
    std::size_t v = 0;
    while (std::find(body.triples.at(v).begin(), body.triples[v].end(), f) == body.triples[v].end()) ++v;
    const std::size_t first = v;
    std::vector<VertexId> loop;
    do {
      loop.push_back(make_id<VertexId>(v));
      const std::size_t s = static_cast<std::size_t>(std::find(body.triples[v].begin(), body.triples[v].end(), f) - body.triples[v].begin());
      v = find_with(f, body.triples[v][(s + 2) % 3], 1);
    } while (v != first && loop.size() <= n);
    body.loops.add(loop);
    body.planes.push_back(planes[i]);
    body.addresses.push_back({});
  }
  return body;
}

inline PlaneBody cube(long long h = 1) {
  return simple_body({{-1, 0, 0, h}, {1, 0, 0, h}, {0, -1, 0, h}, {0, 1, 0, h}, {0, 0, -1, h}, {0, 0, 1, h}});
}
inline PlaneBody tetrahedron() { return simple_body({{-1, -1, -1, 1}, {-1, 1, 1, 1}, {1, -1, 1, 1}, {1, 1, -1, 1}}); }

/// Twelve planes near those of a dodecahedron, with no symmetry left.
inline PlaneBody generic_dodecahedron() {
  return simple_body({{3, 813, 1300, 1521},   {-7, 801, -1297, 1533}, {5, -799, 1309, 1499},  {11, -817, -1301, 1541},
                      {1303, 2, 809, 1507},   {-1291, 9, 803, 1529},  {1307, -4, -811, 1513}, {-1299, 8, -797, 1537},
                      {805, 1311, 6, 1519},   {-815, 1293, -1, 1523}, {795, -1305, 10, 1511}, {-807, -1289, 12, 1527}});
}

/// The static planar honeycomb of a body after `levels` steps, with snapped planes.
inline PlaneBody honeycomb(const PlaneBody& base, int levels) {
  SnappedLevel level = snapped_start(base);
  for (int i = 0; i < levels; ++i) level = snapped_step(std::move(level), static_policy_rational(), {}).level;
  return to_plane_body(level);
}

}  // namespace hexact::samples
