// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/embedded.hpp"

#include "hexact/exact/body_from_soup.hpp"
#include "hexact/exact/certify.hpp"
#include "hexact/exact/sample_solids.hpp"
#include "soup_fixtures.hpp"
#include "solid_samples.hpp"

#include <catch2/catch.hpp>

#include <map>
#include <random>

using namespace hexact;

namespace {

using fixtures::soup_of;
using Polygon = std::vector<Point3<Rational>>;

PlaneBody sample(const char* name) { return body_from_soup(std::get<PolygonSoup<Rational>>(sample_solid(name)), SoupRule::planar); }

/// A cube of side 2 with a pyramid pushed into its top, down to the height of the apex.
PlaneBody pit(const Rational& apex) {
  return body_from_soup(soup_of({{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}, {0, 0, apex}},
                                {{3, 2, 1, 0}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 8}, {5, 6, 8}, {6, 7, 8}, {7, 4, 8}}),
                        SoupRule::planar);
}

/// Polygons with integer corners as a body: each vertex on three planes without facets, equal corners once.
PlaneBody loose(const std::vector<std::vector<std::array<long, 3>>>& polygons) {
  PlaneBody body;
  std::map<std::array<long, 3>, std::size_t> number;
  std::vector<std::array<long, 3>> points;
  for (const auto& polygon : polygons) {
    for (const auto& p : polygon) {
      const auto [at, fresh] = number.insert({p, points.size()});
      if (fresh) points.push_back(p);
      body.loops.add_corner(make_id<VertexId>(at->second));
    }
    body.loops.close_loop();
    const auto minus = [](const auto& p, const auto& q) { return std::array<long, 3>{p[0] - q[0], p[1] - q[1], p[2] - q[2]}; };
    const auto u = minus(polygon[1], polygon[0]), v = minus(polygon[2], polygon[1]);
    const std::array<long, 3> n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const long d = n[0] * polygon[0][0] + n[1] * polygon[0][1] + n[2] * polygon[0][2];
    body.planes.push_back(IntegerPlanes::Narrow{n[0], n[1], n[2], d});
  }
  for (const auto& p : points) {
    std::array<FacetId, 3> triple{};
    for (std::size_t k = 0; k < 3; ++k) {
      triple[k] = make_id<FacetId>(body.planes.size());
      body.planes.push_back(IntegerPlanes::Narrow{k == 0, k == 1, k == 2, p[k]});
      body.loops.close_loop();
    }
    body.triples.push_back(triple);
  }
  body.addresses.resize(body.planes.size());
  return body;
}

// ---- the slow way: convex polygons clipped exactly by half-spaces

Rational dot(const Point3<Rational>& p, const Point3<Rational>& q) { return p.x * q.x + p.y * q.y + p.z * q.z; }
Point3<Rational> minus(const Point3<Rational>& p, const Point3<Rational>& q) { return {p.x - q.x, p.y - q.y, p.z - q.z}; }
Point3<Rational> cross(const Point3<Rational>& p, const Point3<Rational>& q) {
  return {p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
}

/// The part of a convex polygon, segment or point where n·(x − p) >= 0.
Polygon clipped(const Polygon& polygon, const Point3<Rational>& n, const Point3<Rational>& p) {
  Polygon out;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const auto &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const Rational s = dot(n, minus(a, p)), t = dot(n, minus(b, p));
    if (s.sign() >= 0) out.push_back(a);
    if (s.sign() * t.sign() >= 0) continue;
    const Rational share = s / (s - t);
    out.push_back({a.x + share * (b.x - a.x), a.y + share * (b.y - a.y), a.z + share * (b.z - a.z)});
  }
  return out;
}

/// Corners of the intersection of two triangles.
Polygon intersection(Polygon p, const Polygon& q) {
  const Point3<Rational> n = cross(minus(q[1], q[0]), minus(q[2], q[0]));
  p = clipped(p, n, q[0]);
  p = clipped(p, {-n.x, -n.y, -n.z}, q[0]);
  for (std::size_t i = 0; i < 3; ++i) p = clipped(p, cross(n, minus(q[(i + 1) % 3], q[i])), q[i]);
  return p;
}

bool on_segment(const Point3<Rational>& x, const Point3<Rational>& a, const Point3<Rational>& b) {
  const auto c = cross(minus(b, a), minus(x, a));
  return c.x.is_zero() && c.y.is_zero() && c.z.is_zero() && dot(minus(a, x), minus(b, x)).sign() <= 0;
}

/// Whether two triangles meet outside of their common corners and side.
bool slow_contact(const Polygon& p, const Polygon& q) {
  Polygon common;
  for (const auto& x : p) {
    if (std::find(q.begin(), q.end(), x) != q.end()) common.push_back(x);
  }
  if (common.size() == 3) return true;
  const Polygon meet = intersection(p, q);
  return std::any_of(meet.begin(), meet.end(), [&](const auto& x) {
    return common.empty() || (common.size() == 1 ? !(x == common[0]) : !on_segment(x, common[0], common[1]));
  });
}

}  // namespace

TEST_CASE("sample solids and honeycombs are embedded", "[embedded]") {
  for (const char* name : {"l-prism", "u-prism", "star-prism", "frame", "cube", "octahedron", "cuboctahedron"}) {
    INFO(name);
    CHECK(embedded_fault(sample(name)).empty());
  }
  CHECK(embedded_fault(samples::honeycomb(samples::generic_dodecahedron(), 2)).empty());
  CHECK(embedded_fault(body_from_soup(fixtures::triangulated_cube(), SoupRule::planar)).empty());  // coplanar neighbours
  CHECK(embedded_fault(planar_saddle()).empty());
  CHECK(embedded_fault(body_from_soup(std::get<PolygonSoup<QuadraticField>>(sample_solid("dodecahedron")))).empty());
}

TEST_CASE("a spike through a facet is refuted with a point, also where it only touches", "[embedded]") {
  CHECK(embedded_fault(pit(fixtures::fraction(-999, 1000))).empty());
  CHECK(embedded_fault(pit(-1)) == "facet 0 and facet 5: both contain (0, 0, -1), which is on no common vertex or edge");
  const auto contact = first_facet_contact(pit(-2));
  REQUIRE(contact);
  CHECK(contact->first == 0);
  CHECK(contact->second == 5);
  CHECK(contact->point == "(-1/3, -1/3, -1)");
}

TEST_CASE("the witness is in file coordinates", "[embedded]") {
  PlaneBody body = pit(-1);
  body.scale = 3;
  body.shift = {Rational(10), Rational(0), Rational(-1)};
  REQUIRE(first_facet_contact(body));
  CHECK(first_facet_contact(body)->point == "(10, 0, -9)");
}

TEST_CASE("crossing prisms have a contact; nested and disjoint ones have none", "[embedded]") {
  const auto box = [](long x0, long x1, long y0, long y1, long z0, long z1) {
    return std::vector<std::vector<std::array<long, 3>>>{
        {{x0, y0, z0}, {x0, y1, z0}, {x1, y1, z0}, {x1, y0, z0}}, {{x0, y0, z1}, {x1, y0, z1}, {x1, y1, z1}, {x0, y1, z1}},
        {{x0, y0, z0}, {x1, y0, z0}, {x1, y0, z1}, {x0, y0, z1}}, {{x1, y1, z0}, {x0, y1, z0}, {x0, y1, z1}, {x1, y1, z1}},
        {{x0, y1, z0}, {x0, y0, z0}, {x0, y0, z1}, {x0, y1, z1}}, {{x1, y0, z0}, {x1, y1, z0}, {x1, y1, z1}, {x1, y0, z1}}};
  };
  const auto both = [&](auto a, const auto& b) {
    a.insert(a.end(), b.begin(), b.end());
    return first_facet_contact(loose(a));
  };
  const auto first = box(0, 9, 0, 3, 0, 3);
  CHECK(both(first, box(4, 5, -4, 6, 1, 2)));         // crossing
  CHECK(both(first, box(4, 5, -4, 0, 1, 2)));         // facet on facet
  CHECK(both(first, box(9, 12, 3, 6, 3, 6)) == std::nullopt);  // one common corner, by number
  CHECK(both(first, box(9, 12, 3, 6, 2, 6)));         // edge on edge
  CHECK_FALSE(both(first, box(4, 5, 1, 2, 1, 2)));    // inside
  CHECK_FALSE(both(first, box(4, 5, 4, 6, 1, 2)));    // beside
}

TEST_CASE("facets that share corners may not cross between them", "[embedded]") {
  // Two squares with a common diagonal; two that share a side and lie on each other; one that folds onto its neighbour.
  CHECK(first_facet_contact(loose({{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {{0, 0, 0}, {1, 1, 2}, {2, 2, 0}, {1, 1, -2}}})));
  CHECK_FALSE(first_facet_contact(loose({{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {{0, 0, 0}, {-1, -1, 2}, {-2, -2, 0}, {-1, -1, -2}}})));
  CHECK(first_facet_contact(loose({{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {{2, 0, 0}, {0, 0, 0}, {1, 1, 0}}})));
  CHECK_FALSE(first_facet_contact(loose({{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}}, {{2, 0, 0}, {0, 0, 0}, {1, -1, 0}}})));
  CHECK(first_facet_contact(loose({{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}}, {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}}})));
  // An L around a square in its plane: in the notch it is free, beyond it is not.
  const std::vector<std::array<long, 3>> l{{0, 0, 0}, {4, 0, 0}, {4, 2, 0}, {2, 2, 0}, {2, 4, 0}, {0, 4, 0}};
  CHECK_FALSE(first_facet_contact(loose({l, {{3, 3, 0}, {4, 3, 0}, {4, 4, 0}, {3, 4, 0}}})));
  CHECK_FALSE(first_facet_contact(loose({l, {{2, 2, 0}, {4, 2, 0}, {4, 4, 0}, {2, 4, 0}}})));
  CHECK(first_facet_contact(loose({l, {{1, 1, 0}, {4, 3, 0}, {4, 4, 0}, {3, 4, 0}}})));
  // Through the notch, and through a leg.
  CHECK_FALSE(first_facet_contact(loose({l, {{3, 3, -1}, {4, 4, -1}, {4, 4, 1}, {3, 3, 1}}})));
  CHECK(first_facet_contact(loose({l, {{1, 3, -1}, {2, 4, -1}, {2, 4, 1}, {1, 3, 1}}})));
}

TEST_CASE("facets that are no simple polygons are named", "[embedded]") {
  const auto finding = [](const std::vector<std::array<long, 3>>& polygon) {
    const auto found = facet_findings(loose({polygon}));
    return found.empty() ? std::string() : found.front().element + " " + found.front().code + ": " + found.front().message;
  };
  CHECK(finding({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {1, 1, 0}}).empty());
  CHECK(finding({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {3, 1, 0}}).empty());                                // reflex
  CHECK(finding({{0, 0, 0}, {2, 0, 0}, {4, 0, 0}, {4, 4, 0}}) .empty() == false);                      // no plane: its normal is 0
  CHECK(finding({{4, 0, 0}, {4, 4, 0}, {0, 0, 0}, {2, 0, 0}}).empty());                                // a corner of 180 degrees
  CHECK(finding({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {1, -1, 0}}) == "facet 0 FacetNotSimple: edge 0-1 and edge 2-3 meet");
  CHECK(finding({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {2, 0, 0}}) == "facet 0 FacetNotSimple: turns back at vertex 0");
  CHECK(finding({{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {4, 2, 0}}) == "facet 0 FacetNotSimple: turns back at vertex 2");
  // The plane comes from the first corner, here a reflex one.
  CHECK(finding({{4, 0, 1}, {1, 1, 1}, {0, 4, 1}, {0, 0, 1}}) == "facet 0 FacetNotSimple: runs clockwise about its normal");
  // A pentagram turns left everywhere.
  CHECK_FALSE(finding({{0, 3, 0}, {-2, -3, 0}, {3, 1, 0}, {-3, 1, 0}, {2, -3, 0}}).empty());
}

TEST_CASE("triangles with small integer corners: every pair as exact clipping decides it", "[embedded]") {
  std::mt19937 random(20261125);
  const auto digit = [&] { return static_cast<long>(random() % 4); };
  std::size_t contacts = 0, trials = 0;
  while (trials < 4000) {
    std::vector<std::vector<std::array<long, 3>>> triangles(2);
    for (auto& t : triangles) {
      for (int i = 0; i < 3; ++i) t.push_back({digit(), digit(), digit()});
    }
    for (std::size_t i = 0; i < trials % 3; ++i) triangles[1][i] = triangles[0][(i + trials) % 3];
    std::vector<Polygon> exact(2);
    bool flat = false;
    for (std::size_t i = 0; i < 2; ++i) {
      for (const auto& p : triangles[i]) exact[i].push_back({Rational(p[0]), Rational(p[1]), Rational(p[2])});
      const auto n = cross(minus(exact[i][1], exact[i][0]), minus(exact[i][2], exact[i][0]));
      flat = flat || (n.x.is_zero() && n.y.is_zero() && n.z.is_zero());
    }
    if (flat) continue;
    ++trials;
    const bool expected = slow_contact(exact[0], exact[1]);
    contacts += expected ? 1 : 0;
    CAPTURE(trials);
    REQUIRE(first_facet_contact(loose(triangles)).has_value() == expected);
  }
  CHECK(contacts > 800);
  CHECK(contacts < 3200);
}

TEST_CASE("the claim embedded", "[embedded][certify]") {
  const auto verdict = [](const PlaneBody& body) { return verify(make_certificate(body, {{"embedded", ""}}, {}, {})).front(); };
  CHECK(verdict(sample("frame")).verdict == Verdict::proved);
  CHECK(verdict(pit(-2)).verdict == Verdict::refuted);
  PlaneBody turned = sample("l-prism");
  FacetLoops loops;
  for (std::size_t f = 0; f < turned.loops.size(); ++f) {
    std::vector<VertexId> loop(turned.loops[f].rbegin(), turned.loops[f].rend());
    loops.add(loop);
  }
  turned.loops = loops;
  CHECK(verdict(turned).witness == "facet 0: runs clockwise about its normal");
  for (std::size_t f = 0; f < turned.planes.size(); ++f) {
    const Plane<Integer> p = turned.planes[f];
    turned.planes.set(f, Plane<Integer>{-p.a, -p.b, -p.c, -p.d});
  }
  CHECK(verdict(turned).witness == "the normals point inward: the volume is negative");
}
