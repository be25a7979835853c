// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/body_from_soup.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <initializer_list>
#include <set>

using namespace hexact;

namespace {

PolygonSoup<Rational> soup_of(std::initializer_list<std::array<Rational, 3>> points,
                              std::initializer_list<std::vector<int>> facets) {
  PolygonSoup<Rational> soup;
  for (const auto& p : points) soup.points.push_back({p[0], p[1], p[2]});
  for (const auto& list : facets) {
    for (int v : list) soup.facets.add_corner(make_id<VertexId>(static_cast<std::size_t>(v)));
    soup.facets.close_loop();
  }
  return soup;
}

PolygonSoup<Rational> cube(const Rational& s = 1) {
  return soup_of({{-s, -s, -s}, {-s, -s, s}, {-s, s, -s}, {-s, s, s}, {s, -s, -s}, {s, -s, s}, {s, s, -s}, {s, s, s}},
                 {{0, 1, 3, 2}, {4, 6, 7, 5}, {0, 4, 5, 1}, {2, 3, 7, 6}, {0, 2, 6, 4}, {1, 5, 7, 3}});
}

PolygonSoup<Rational> pyramid() {
  return soup_of({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}},
                 {{3, 2, 1, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
}

std::set<std::string> codes(const std::vector<Finding>& findings) {
  std::set<std::string> all;
  for (const Finding& f : findings) all.insert(f.code);
  return all;
}

bool has(const std::vector<Finding>& findings, const std::string& code, const std::string& element) {
  for (const Finding& f : findings) {
    if (f.code == code && f.element == element) return true;
  }
  return false;
}

using Codes = std::set<std::string>;

}  // namespace

TEST_CASE("the planes of a cube are coprime integers and give its corners back", "[body]") {
  for (const Rational& s : {Rational(1), Rational(Integer(1), Integer(8)), Rational(Integer(1), Integer(10)), Rational(1).scaled(1000),
                            Rational(1).scaled(-1000)}) {
    const PlaneBody body = body_from_soup(cube(s));
    REQUIRE(body.planes.size() == 6);
    CHECK(body.planes.wide_count() == 0);
    const PolygonSoup<Rational> back = rational_soup(body);
    CHECK(back.points == cube(s).points);
    CHECK(back.facets == cube().facets);
  }
  const PlaneBody body = body_from_soup(cube());
  CHECK(body.scale == 0);
  CHECK(body.planes[0] == Plane<Integer>{-1, 0, 0, 1});
  CHECK(body.planes[5] == Plane<Integer>{0, 0, 1, 1});
  // Vertex 0, counter-clockwise from its smallest facet (see the topology test).
  CHECK(body.triples[0] == std::array<FacetId, 3>{FacetId{0}, FacetId{4}, FacetId{2}});
  CHECK(convex_trivalent_findings(body).empty());
}

TEST_CASE("vertices of higher valence get an independent triple, and are not trivalent", "[body]") {
  const PlaneBody body = body_from_soup(pyramid());
  CHECK(rational_soup(body).points == pyramid().points);
  const auto findings = convex_trivalent_findings(body);
  CHECK(codes(findings) == Codes{"NotTrivalent"});
  CHECK(has(findings, "NotTrivalent", "vertex 4"));
}

TEST_CASE("a body without a short common denominator is still exact", "[body]") {
  PolygonSoup<Rational> soup = cube();
  // Each coordinate 1 moves to 1 + 3^-k: still a box, with a 5000-bit denominator.
  Integer p;
  mpz_ui_pow_ui(p.raw(), 3, 3200);
  for (auto& q : soup.points) {
    if (q.x == Rational(1)) q.x += Rational(Integer(1), p);
  }
  const PlaneBody body = body_from_soup(soup);
  CHECK(rational_soup(body).points == soup.points);
}

TEST_CASE("each thing that is wrong is named, beside the cube that has none of it", "[body]") {
  CHECK(examine_soup(cube()).findings.empty());
  CHECK(examine_soup(cube()).strictly_convex);

  SECTION("a corner off its planes") {
    PolygonSoup<Rational> soup = cube();
    soup.points[7].x += Rational(1).scaled(-2000);  // stays on the planes of facets 3 and 5
    CHECK(examine_soup(soup).bent_facets == std::vector<std::size_t>{1});
    soup.points[7].y += Rational(1);
    soup.points[7].z += Rational(1);
    const auto shape = examine_soup(soup);
    CHECK_FALSE(shape.planar);
    CHECK(has(shape.findings, "FaceNotPlanar", "facet 3"));
    CHECK(has(shape.findings, "FaceNotPlanar", "facet 5"));
    CHECK(shape.bent_facets == std::vector<std::size_t>{1, 3, 5});
  }
  SECTION("a missing facet, an extra vertex, a second vertex at the same place") {
    PolygonSoup<Rational> soup = cube();
    soup.points.push_back(soup.points[2]);
    CHECK(codes(examine_soup(soup).findings) == Codes{"DuplicateVertices", "UnusedVertex"});
    CHECK(has(examine_soup(soup).findings, "DuplicateVertices", "vertex 8"));
    const auto open = soup_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
    CHECK(codes(examine_soup(open).findings) == Codes{"HasBoundary"});
  }
  SECTION("inside out") {
    PolygonSoup<Rational> soup = cube();
    for (auto& q : soup.points) q.x = -q.x;
    CHECK(codes(examine_soup(soup).findings) == Codes{"InsideOut"});
  }
  SECTION("a straight corner on an edge") {
    const auto soup = soup_of({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0}},
                              {{0, 2, 1, 4}, {0, 4, 1, 3}, {1, 2, 3}, {2, 0, 3}});
    const auto shape = examine_soup(soup);
    CHECK(shape.planar);
    CHECK(has(shape.findings, "FaceNotStrictlyConvex", "facet 0"));
    CHECK(has(shape.findings, "FaceNotStrictlyConvex", "facet 1"));
  }
  SECTION("coplanar neighbours") {
    const auto soup = soup_of({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}},
                              {{2, 1, 0}, {3, 2, 0}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    const auto shape = examine_soup(soup);
    CHECK(has(shape.findings, "EdgeNotStrictlyConvex", "edge 0-2"));
    CHECK(shape.findings.size() == 1);
    CHECK(examine_soup(soup, SoupRule::planar).findings.empty());
  }
  SECTION("a dent") {
    auto soup = pyramid();
    // An octahedron whose lower apex is pushed inside: all facets triangles, four reflex edges.
    soup = soup_of({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {0, 0, 1}, {0, 0, Rational(Integer(1), Integer(4))}},
                   {{1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
    const auto shape = examine_soup(soup);
    CHECK(codes(shape.findings) == Codes{"EdgeNotStrictlyConvex"});
    CHECK(has(shape.findings, "EdgeNotStrictlyConvex", "edge 0-5"));
    CHECK_FALSE(has(shape.findings, "EdgeNotStrictlyConvex", "edge 0-1"));
  }
  SECTION("two parts") {
    PolygonSoup<Rational> soup = cube();
    for (std::size_t v = 0; v < 8; ++v) soup.points.push_back({cube().points[v].x + 5, soup.points[v].y, soup.points[v].z});
    const FacetLoops first = soup.facets;
    for (std::size_t f = 0; f < 6; ++f) {
      for (VertexId v : first[f]) soup.facets.add_corner(make_id<VertexId>(index(v) + 8));
      soup.facets.close_loop();
    }
    CHECK(codes(examine_soup(soup).findings) == Codes{"NotConnected"});
  }
  SECTION("a facet without area") {
    const auto soup = soup_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, {{0, 1, 2}, {2, 1, 0}});
    CHECK(has(examine_soup(soup).findings, "FaceNotPlanar", "facet 0"));
  }
}

TEST_CASE("a torus of planar facets has the wrong characteristic", "[body]") {
  // A square frame: outer and inner square prism, 16 vertices; top and bottom as four trapezoids each.
  PolygonSoup<Rational> soup;
  for (int ring : {2, 1}) {
    for (int z : {0, 1}) {
      for (auto [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) soup.points.push_back({ring * x, ring * y, z});
    }
  }
  const auto add = [&](std::initializer_list<int> list) {
    for (int v : list) soup.facets.add_corner(make_id<VertexId>(static_cast<std::size_t>(v)));
    soup.facets.close_loop();
  };
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    add({i, j, 4 + j, 4 + i});
    add({8 + j, 8 + i, 12 + i, 12 + j});
    add({4 + i, 4 + j, 12 + j, 12 + i});
    add({j, i, 8 + i, 8 + j});
  }
  const auto shape = examine_soup(soup);
  CHECK(shape.topology.euler == 0);
  CHECK(codes(shape.findings).count("BadEuler") == 1);
  CHECK(examine_soup(soup, SoupRule::planar).findings.empty());
}

TEST_CASE("the great icosahedron passes every edge and is not convex", "[body]") {
  // The icosahedron's vertices and combinatorics, joined after the automorphism √5 -> −√5 of the field.
  using Q5 = QuadraticField;
  const Q5 phi(Rational(Integer(1), Integer(2)), Rational(Integer(1), Integer(2)));
  const Q5 conjugate(Rational(Integer(1), Integer(2)), Rational(Integer(-1), Integer(2)));
  const auto icosahedron = [&](const Q5& g) {
    PolygonSoup<Q5> soup;
    for (int a : {-1, 1}) {
      for (int b : {-1, 1}) {
        const Q5 s(a), t = Q5(b) * g;
        soup.points.push_back({Q5(0), s, t});
        soup.points.push_back({s, t, Q5(0)});
        soup.points.push_back({t, Q5(0), s});
      }
    }
    return soup;
  };
  PolygonSoup<Q5> convex = icosahedron(phi);
  const auto squared = [&](std::size_t i, std::size_t j) {
    const Q5 x = convex.points[i].x - convex.points[j].x, y = convex.points[i].y - convex.points[j].y,
             z = convex.points[i].z - convex.points[j].z;
    return x * x + y * y + z * z;
  };
  for (std::size_t i = 0; i < 12; ++i) {
    for (std::size_t j = i + 1; j < 12; ++j) {
      for (std::size_t k = j + 1; k < 12; ++k) {
        if (!(squared(i, j) == Q5(4) && squared(j, k) == Q5(4) && squared(i, k) == Q5(4))) continue;
        const auto &p = convex.points[i], &q = convex.points[j], &r = convex.points[k];
        const Q5 det = p.x * (q.y * r.z - q.z * r.y) - p.y * (q.x * r.z - q.z * r.x) + p.z * (q.x * r.y - q.y * r.x);
        const bool outward = det.sign() > 0;
        for (std::size_t v : {i, outward ? j : k, outward ? k : j}) convex.facets.add_corner(make_id<VertexId>(v));
        convex.facets.close_loop();
      }
    }
  }
  REQUIRE(convex.facets.size() == 20);
  CHECK(examine_soup(convex).findings.empty());
  CHECK(sqrt5_soup(body_from_soup(convex)).points == convex.points);

  PolygonSoup<Q5> great = icosahedron(conjugate);
  great.facets = convex.facets;
  auto shape = examine_soup(great);
  if (codes(shape.findings).count("InsideOut") == 1) {
    for (auto& p : great.points) p.x = -p.x;
    shape = examine_soup(great);
  }
  CHECK(shape.topology.euler == 2);
  CHECK(codes(shape.findings) == Codes{"VertexNotStrictlyConvex"});
  CHECK(shape.findings.size() == 12);
}

TEST_CASE("a prism over a pentagram turns twice", "[body]") {
  PolygonSoup<Rational> soup;
  // A convex pentagon in integers, listed in star order.
  const std::array<std::array<int, 2>, 5> pentagon{{{10, 0}, {3, 9}, {-8, 6}, {-8, -6}, {3, -9}}};
  for (int z : {0, 1}) {
    for (int i = 0; i < 5; ++i) soup.points.push_back({pentagon[static_cast<std::size_t>(2 * i % 5)][0], pentagon[static_cast<std::size_t>(2 * i % 5)][1], z});
  }
  const auto add = [&](std::vector<int> list) {
    for (int v : list) soup.facets.add_corner(make_id<VertexId>(static_cast<std::size_t>(v)));
    soup.facets.close_loop();
  };
  add({4, 3, 2, 1, 0});
  add({5, 6, 7, 8, 9});
  for (int i = 0; i < 5; ++i) add({i, (i + 1) % 5, 5 + (i + 1) % 5, 5 + i});
  const auto shape = examine_soup(soup);
  CHECK(has(shape.findings, "FaceNotStrictlyConvex", "facet 0"));
  CHECK(has(shape.findings, "FaceNotStrictlyConvex", "facet 1"));
  CHECK(shape.findings.size() == 2);
}

TEST_CASE("findings of a body of planes", "[body]") {
  PlaneBody body = body_from_soup(cube());
  SECTION("a plane turned inward") {
    body.planes.set(0, IntegerPlanes::Narrow{1, 0, 0, -1});
    const auto findings = convex_trivalent_findings(body);
    CHECK(has(findings, "PlaneFacesInward", "facet 0"));
  }
  SECTION("a vertex that names a wrong triple") {
    std::swap(body.triples[0], body.triples[1]);
    CHECK(codes(convex_trivalent_findings(body)).count("NotOnPlane") == 1);
  }
  SECTION("a triple without a point") {
    body.triples[0] = {FacetId{0}, FacetId{1}, FacetId{2}};
    CHECK_THROWS_AS(convex_trivalent_findings(body), InvalidInput);
  }
}
