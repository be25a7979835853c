// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/prepare.hpp"

#include "hexact/exact/body_from_soup.hpp"
#include "hexact/exact/convex_hull.hpp"
#include "hexact/exact/corner_cut.hpp"
#include "hexact/exact/dual.hpp"
#include "hexact/exact/fit_planes.hpp"
#include "hexact/exact/honeycomb.hpp"
#include "hexact/exact/merge_coplanar.hpp"
#include "hexact/exact/snap_planes.hpp"
#include "hexact/exact/triangulate.hpp"
#include "hexact/exact/truncate.hpp"
#include "hexact/exact/volume.hpp"
#include "soup_fixtures.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace hexact;
using namespace hexact::fixtures;

namespace {

Rational volume(const PolygonSoup<Rational>& soup) { return exact_volume(std::span(soup.points), soup.facets); }

/// Every coordinate rounded to a double, as a mesh file holds it.
PolygonSoup<Rational> rounded(const PolygonSoup<Rational>& soup) {
  PolygonSoup<Rational> result = soup;
  for (auto& p : result.points) {
    for (Rational* x : {&p.x, &p.y, &p.z}) *x = Rational::from_double(x->to_double());
  }
  return result;
}

std::vector<Point3<Rational>> random_points(std::uint64_t seed, std::size_t n, long range) {
  SplitMix64 random{seed};
  std::vector<Point3<Rational>> points;
  for (std::size_t i = 0; i < n; ++i) {
    const long x = random.between(-range, range), y = random.between(-range, range), z = random.between(-range, range);
    points.push_back({x, y, z});
  }
  return points;
}

}  // namespace

// ---- merging -------------------------------------------------------------------------------------------------

TEST_CASE("a triangulated cube becomes the cube again", "[prepare][merge]") {
  const auto merged = merge_coplanar(triangulated_cube());
  CHECK(merged.soup.points == cube().points);
  CHECK(merged.soup.facets == cube().facets);
  CHECK(merged.merged_facets == 6);
  CHECK(merged.dropped_vertices == 0);
  const auto unchanged = merge_coplanar(cube());
  CHECK(unchanged.merged_facets == 0);
  CHECK(unchanged.soup.facets == cube().facets);
}

TEST_CASE("straight corners of both their facets and unused vertices are dropped", "[prepare][merge]") {
  // A tetrahedron with a vertex in the middle of an edge, and a fourth triangle split in the middle.
  const auto soup = soup_of({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0}, {7, 7, 7}},
                            {{0, 2, 4}, {4, 2, 1}, {0, 4, 3}, {4, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  const auto merged = merge_coplanar(soup);
  CHECK(counts(merged.soup) == Counts{4, 6, 4});
  CHECK(merged.merged_facets == 2);
  CHECK(merged.dropped_vertices == 2);
  CHECK(examine_soup(merged.soup).strictly_convex);
}

TEST_CASE("a triangle without area joins the facet at its longest edge", "[prepare][merge]") {
  // The edge 0-1 of a tetrahedron carries a vertex 4 on one side only; the sliver 0,4,1 closes the gap.
  const auto soup = soup_of({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 2}, {1, 0, 0}},
                            {{0, 2, 1}, {0, 4, 3}, {4, 1, 3}, {0, 1, 4}, {1, 2, 3}, {2, 0, 3}});
  const auto merged = merge_coplanar(soup);
  CHECK(counts(merged.soup) == Counts{4, 6, 4});
}

TEST_CASE("what cannot be merged into one loop is refused by name", "[prepare][merge]") {
  // A square plate with a square tower: the plate around the tower is a facet with a hole.
  PolygonSoup<Rational> soup;
  for (int z : {0, 1}) {
    for (auto [x, y] : {std::pair{3, 3}, {-3, 3}, {-3, -3}, {3, -3}}) soup.points.push_back({x, y, z});
  }
  for (int z : {1, 2}) {
    for (auto [x, y] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) soup.points.push_back({x, y, z});
  }
  const auto add = [&](std::initializer_list<int> list) {
    for (int v : list) soup.facets.add_corner(make_id<VertexId>(static_cast<std::size_t>(v)));
    soup.facets.close_loop();
  };
  add({3, 2, 1, 0});
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    add({i, j, 4 + j, 4 + i});
    add({4 + i, 4 + j, 8 + j, 8 + i});
    add({8 + i, 8 + j, 12 + j, 12 + i});
  }
  add({12, 13, 14, 15});
  REQUIRE(examine_soup(soup, SoupRule::planar).findings.empty());
  CHECK(codes_thrown_by([&] { (void)merge_coplanar(soup); }) == Codes{"FacetWithHole"});

  PolygonSoup<Rational> apart = cube();
  for (std::size_t v = 0; v < 8; ++v) {
    const Point3<Rational> p = apart.points[v];
    apart.points.push_back({p.x + 9, p.y, p.z});
  }
  const FacetLoops first = cube().facets;
  for (std::size_t f = 0; f < 6; ++f) {
    for (VertexId v : first[f]) apart.facets.add_corner(make_id<VertexId>(index(v) + 8));
    apart.facets.close_loop();
  }
  CHECK(codes_thrown_by([&] { (void)merge_coplanar(apart); }) == Codes{"NotConnected"});
}

// ---- hull ----------------------------------------------------------------------------------------------------

TEST_CASE("the hull of a grid is the cube", "[prepare][hull]") {
  std::vector<Point3<Rational>> grid;
  for (int x : {-1, 0, 1})
    for (int y : {-1, 0, 1})
      for (int z : {-1, 0, 1}) grid.push_back({x, y, z});
  grid.push_back({1, 1, 1});
  const auto hull = convex_hull(grid);
  CHECK(counts(hull) == Counts{8, 12, 6});
  CHECK(volume(hull) == Rational(8));
  CHECK(examine_soup(hull).strictly_convex);
  CHECK(codes_thrown_by([&] { (void)convex_hull<Rational>({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {5, 5, 0}}); }) == Codes{"NotSolid"});
  CHECK(codes_thrown_by([&] { (void)convex_hull<Rational>({}); }) == Codes{"NotSolid"});
}

TEST_CASE("random hulls agree with testing every triple of points", "[prepare][hull]") {
  for (std::uint64_t seed = 1; seed <= 12; ++seed) {
    CAPTURE(seed);
    const long range = seed % 3 == 0 ? 2 : seed % 3 == 1 ? 6 : 1000;  // small ranges: many coplanar points
    const auto points = random_points(seed, 25, range);
    const auto hull = convex_hull(points);
    REQUIRE(examine_soup(hull).findings.empty());
    // Brute force: planes through three points with all others on one side, each with the points on it.
    std::set<std::set<std::array<Rational, 3>>> faces;
    const auto less_side = [&](std::size_t i, std::size_t j, std::size_t k, std::size_t m) {
      const auto diff = [&](std::size_t a) {
        return std::array<Rational, 3>{points[a].x - points[i].x, points[a].y - points[i].y, points[a].z - points[i].z};
      };
      const auto p = diff(j), q = diff(k), r = diff(m);
      return ((p[1] * q[2] - p[2] * q[1]) * r[0] + (p[2] * q[0] - p[0] * q[2]) * r[1] +
              (p[0] * q[1] - p[1] * q[0]) * r[2]).sign();
    };
    std::set<std::array<Rational, 3>> hull_points;
    for (const auto& p : hull.points) hull_points.insert({p.x, p.y, p.z});
    for (std::size_t i = 0; i < points.size(); ++i) {
      for (std::size_t j = i + 1; j < points.size(); ++j) {
        for (std::size_t k = j + 1; k < points.size(); ++k) {
          std::set<int> sides;
          std::set<std::array<Rational, 3>> on;
          for (std::size_t m = 0; m < points.size(); ++m) {
            const int s = less_side(i, j, k, m);
            sides.insert(s);
            const std::array<Rational, 3> p{points[m].x, points[m].y, points[m].z};
            if (s == 0 && hull_points.count(p) == 1) on.insert(p);
          }
          if (sides.count(0) == 1 && sides.size() == 2) faces.insert(on);
        }
      }
    }
    std::set<std::set<std::array<Rational, 3>>> ours;
    for (std::size_t f = 0; f < hull.facets.size(); ++f) {
      std::set<std::array<Rational, 3>> corners;
      for (VertexId v : hull.facets[f]) {
        const auto& p = hull.points[index(v)];
        corners.insert({p.x, p.y, p.z});
      }
      ours.insert(corners);
    }
    CHECK(ours == faces);
    CHECK(ours.size() == hull.facets.size());
  }
}

TEST_CASE("the hull does not depend on the order of the points, and takes any magnitude", "[prepare][hull]") {
  auto points = random_points(5, 60, 50);
  const Rational v = volume(convex_hull(points));
  std::reverse(points.begin(), points.end());
  CHECK(volume(convex_hull(points)) == v);
  for (long e : {-2000L, -340L, 300L, 3000L}) {
    auto scaled = points;
    for (auto& p : scaled) p = {p.x.scaled(e), p.y.scaled(e), p.z.scaled(e)};
    CHECK(volume(convex_hull(scaled)) == v.scaled(3 * e));
  }
}

// ---- truncation ----------------------------------------------------------------------------------------------

TEST_CASE("truncation of octahedron and pyramid, phs a.2", "[prepare][truncate]") {
  const auto octa = truncate_vertices(octahedron(), fraction(1, 3));
  CHECK(counts(octa.soup) == Counts{24, 36, 14});
  CHECK(facet_sizes(octa.soup) == Sizes{{4, 6}, {6, 8}});
  CHECK(octa.truncated_vertices == 6);
  // The octahedron of volume 4/3 loses six pyramids similar to half of it with edges scaled by 1/3.
  CHECK(volume(octa.soup) == fraction(4, 3) - Rational(6) * fraction(2, 3) * fraction(1, 27));
  CHECK(convex_trivalent_findings(body_from_soup(octa.soup)).empty());

  const auto roof = truncate_vertices(pyramid(), fraction(1, 4));
  CHECK(counts(roof.soup) == Counts{8, 12, 6});
  CHECK(roof.truncated_vertices == 1);
  CHECK(convex_trivalent_findings(body_from_soup(roof.soup)).empty());
  CHECK(volume(roof.soup) == volume(pyramid()) * fraction(63, 64));

  CHECK(truncate_vertices(cube(), fraction(1, 3)).soup.points == cube().points);
  CHECK(truncate_vertices(cube(), fraction(1, 3)).soup.facets == cube().facets);
  PolygonSoup<Rational> bent = octahedron();
  bent.points[0].x = -2;
  CHECK_FALSE(codes_thrown_by([&] { (void)truncate_vertices(bent, fraction(1, 3)); }).empty());
}

TEST_CASE("truncated random hulls are trivalent and convex", "[prepare][truncate]") {
  for (std::uint64_t seed = 20; seed < 26; ++seed) {
    CAPTURE(seed);
    const auto hull = convex_hull(random_points(seed, 30, 4));
    const auto cut = truncate_vertices(hull, fraction(49, 100));
    CHECK(convex_trivalent_findings(body_from_soup(cut.soup)).empty());
    CHECK(cut.soup.facets.size() == hull.facets.size() + cut.truncated_vertices);
    CHECK(volume(cut.soup) < volume(hull));
  }
}

// ---- dual, corner cut, triangles -----------------------------------------------------------------------------

TEST_CASE("dual and corner cut of the octahedron", "[prepare][dual]") {
  const auto dual = dual_mesh(octahedron());
  CHECK(counts(dual) == Counts{8, 12, 6});
  CHECK(dual.points[0] == Point3<Rational>{fraction(1, 3), fraction(1, 3), fraction(1, 3)});
  CHECK(volume(dual) == fraction(8, 27));
  const auto cut = corner_cut_mesh(octahedron(), fraction(1, 3));
  CHECK(counts(cut) == Counts{24, 36, 14});
  CHECK(volume(cut) == volume(truncate_vertices(octahedron(), fraction(1, 3)).soup));
  CHECK(codes_thrown_by([&] { (void)dual_mesh(soup_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})); }) == Codes{"Empty"});
}

TEST_CASE("with a boundary only inner vertices become facets", "[prepare][dual]") {
  // A square fan of four triangles around vertex 4.
  const auto fan = soup_of({{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 1}}, {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}});
  const auto dual = dual_mesh(fan);
  CHECK(dual.facets.size() == 1);
  CHECK(dual.points.size() == 4);
  const auto cut = corner_cut_mesh(fan, fraction(1, 4));
  CHECK(cut.points.size() == 16);
  CHECK(facet_sizes(cut) == Sizes{{4, 1}, {6, 4}});
  const auto t = analyse_topology(cut.facets, cut.points.size());
  CHECK(t.manifold);
  CHECK(t.boundary_loops == 1);
}

TEST_CASE("triangles keep the region of reflex facets", "[prepare][triangulate]") {
  const auto cubes = triangulate(cube());
  CHECK(cubes.facets == triangulated_cube().facets);
  // An L of area 3; a fan from corner 0 would cover the notch.
  const auto l = soup_of({{2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}, {0, 0, 0}}, {{0, 1, 2, 3, 4, 5}});
  const auto parts = triangulate(l);
  CHECK(parts.facets.size() == 4);
  Rational area(0);
  for (std::size_t f = 0; f < 4; ++f) {
    const auto &a = parts.points[index(parts.facets[f][0])], &b = parts.points[index(parts.facets[f][1])],
               &c = parts.points[index(parts.facets[f][2])];
    const Rational twice = (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
    CHECK(twice.sign() > 0);
    area += twice;
  }
  CHECK(area == Rational(6));
  const auto crossing = soup_of({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {1, -1, 0}}, {{0, 1, 2, 3}});
  CHECK(codes_thrown_by([&] { (void)triangulate(crossing); }) == Codes{"NotSimple"});
}

// ---- exact planes from rounded decimals ----------------------------------------------------------------------

TEST_CASE("a level-2 honeycomb rounded to doubles becomes exact again", "[prepare][planes]") {
  // A generic solid: a truncated random hull, two honeycomb steps with the static rational parameters.
  const auto start = truncate_vertices(convex_hull(random_points(3, 9, 40)), fraction(1, 3)).soup;
  HoneycombLevel<Rational> level = honeycomb_start<Rational>(body_from_soup(start));
  for (int k = 0; k < 2; ++k) level = honeycomb_step(level, static_policy_rational()).level;
  PolygonSoup<Rational> exact;
  exact.points = level.points;
  exact.facets = level.map.loops();
  const PolygonSoup<Rational> given = rounded(exact);
  REQUIRE_FALSE(examine_soup(given).planar);

  const FittedSoup fitted = fit_planes(given);
  CHECK(fitted.soup.facets == given.facets);
  CHECK(convex_trivalent_findings(body_from_soup(fitted.soup)).empty());
  CHECK(body_from_soup(fitted.soup).planes.wide_count() == 0);
  CHECK(fitted.max_displacement > 0);
  CHECK(fitted.max_displacement < 1e-12 * 40);
  for (std::size_t v = 0; v < given.points.size(); ++v) {
    const auto &p = given.points[v], &q = fitted.soup.points[v];
    const Rational x = p.x - q.x, y = p.y - q.y, z = p.z - q.z;
    const Rational bound = Rational::from_double(fitted.max_displacement);
    REQUIRE(x * x + y * y + z * z <= bound * bound);
  }
}

TEST_CASE("vertices and facets of any size together: a rounded cuboctahedron and its kin", "[prepare][planes]") {
  // All vertices have valence 4, squares and triangles meet: neither planes nor vertices alone can go first.
  std::vector<Point3<Rational>> points;
  for (int s : {-1, 1}) {
    for (int t : {-1, 1}) {
      points.push_back({s, t, 0});
      points.push_back({s, 0, t});
      points.push_back({0, s, t});
    }
  }
  PolygonSoup<Rational> soup = convex_hull(points);
  REQUIRE(counts(soup) == Counts{12, 24, 14});
  SplitMix64 random{11};
  for (auto& p : soup.points) {
    for (Rational* x : {&p.x, &p.y, &p.z}) *x += fraction(random.between(-1000, 1000), 1000000000000);
  }
  REQUIRE_FALSE(examine_soup(soup).planar);
  const FittedSoup fitted = fit_planes(soup);
  CHECK(examine_soup(fitted.soup).findings.empty());
  CHECK(fitted.soup.facets == soup.facets);
  CHECK(fitted.max_displacement < 1e-7);
  CHECK(fitted.max_displacement > 0);

  const auto prism = truncate_vertices(convex_hull(random_points(8, 14, 30)), fraction(1, 3)).soup;
  const FittedSoup exact = fit_planes(prism);
  CHECK(exact.max_displacement == 0);
  CHECK(exact.soup.points == prism.points);
}

TEST_CASE("what cannot be made convex is refused with its witness", "[prepare][planes]") {
  PolygonSoup<Rational> dented = octahedron();
  // Vertex 5 pushed far inside: the edges to it are reflex. Triangles are planar, only convexity fails.
  dented.points[5].z = fraction(1, 2);
  CHECK(codes_thrown_by([&] { (void)fit_planes(dented); }) == Codes{"EdgeNotStrictlyConvex"});
  PolygonSoup<Rational> bent = cube();
  bent.points[0].x += fraction(1, 1000);
  bent.points[0].y += fraction(1, 1000);
  bent.points[0].z += fraction(1, 1000);
  CHECK_NOTHROW(fit_planes(bent));
  for (auto& p : bent.points) p.x = -p.x;
  CHECK(codes_thrown_by([&] { (void)fit_planes(bent); }) == Codes{"InsideOut"});
}

// ---- snapping ------------------------------------------------------------------------------------------------

TEST_CASE("snapped planes have the asked size, the combinatorics and a true bound", "[prepare][snap]") {
  const auto solid = truncate_vertices(convex_hull(random_points(3, 9, 40)), fraction(1, 3)).soup;
  for (unsigned bits : {16u, 30u, 70u}) {
    CAPTURE(bits);
    const SnappedBody snapped = snap_planes(solid, bits);
    CHECK(snapped.body.loops == solid.facets);
    CHECK(convex_trivalent_findings(snapped.body).empty());
    for (std::size_t f = 0; f < snapped.body.planes.size(); ++f) {
      const Plane<Integer> p = snapped.body.planes[f];
      for (const Integer* x : {&p.a, &p.b, &p.c, &p.d}) CHECK(x->bit_length() <= bits);
    }
    CHECK(snapped.max_displacement > 0);
    CHECK(snapped.max_displacement < 1e6 * std::ldexp(1.0, -static_cast<int>(bits)));
  }
  CHECK(snap_planes(cube(), 4).max_displacement == 0);
  CHECK(rational_soup(snap_planes(cube(), 4).body).points == cube().points);
  CHECK(codes_thrown_by([&] { (void)snap_planes(solid, 2); }) == Codes{"SnappedTooCoarse"});
  CHECK(codes_thrown_by([&] { (void)snap_planes(pyramid(), 30); }) == Codes{"NotTrivalent"});
}

TEST_CASE("a body far from the origin is snapped about its own middle", "[prepare][snap]") {
  PolygonSoup<Rational> far = truncate_vertices(octahedron(), fraction(1, 3)).soup;
  for (auto& p : far.points) p = {p.x + 1000000, p.y, p.z - fraction(12345, 7)};
  const SnappedBody snapped = snap_planes(far, 30);
  CHECK(convex_trivalent_findings(snapped.body).empty());
  CHECK(snapped.max_displacement < 1e-7);
}

TEST_CASE("snapping turns numbers with sqrt5 into rational planes", "[prepare][snap]") {
  const QuadraticField half(fraction(1, 2));
  const QuadraticField phi(fraction(1, 2), fraction(1, 2)), inverse(fraction(-1, 2), fraction(1, 2));
  std::vector<Point3<QuadraticField>> points;
  for (int a : {-1, 1}) {
    for (int b : {-1, 1}) {
      for (int c : {-1, 1}) points.push_back({QuadraticField(a), QuadraticField(b), QuadraticField(c)});
      const QuadraticField x = QuadraticField(a) * inverse, y = QuadraticField(b) * phi, zero(0);
      points.push_back({zero, x, y});
      points.push_back({y, zero, x});
      points.push_back({x, y, zero});
    }
  }
  const auto dodecahedron = convex_hull(points);
  REQUIRE(facet_sizes(dodecahedron) == Sizes{{5, 12}});
  const SnappedBody snapped = snap_planes(dodecahedron, 40);
  CHECK(snapped.body.field == Field::rational);
  CHECK(convex_trivalent_findings(snapped.body).empty());
  CHECK(snapped.max_displacement < 1e-11);
  CHECK(snapped.max_displacement > 0);
}

// ---- all together --------------------------------------------------------------------------------------------

TEST_CASE("the steps follow each other in the documented order", "[prepare]") {
  PreparedMesh merged = prepare(triangulated_cube(), {});
  CHECK(merged.merged_facets == 6);
  CHECK(std::get<PolygonSoup<Rational>>(merged.soup).facets == cube().facets);

  PrepareOptions dual;
  dual.dual = true;
  CHECK(counts(std::get<PolygonSoup<Rational>>(prepare(triangulated_cube(), dual).soup)) == Counts{12, 18, 8});

  PrepareOptions chain;
  chain.hull = true;
  chain.truncate = fraction(1, 3);
  chain.snap_bits = 40;
  const PreparedMesh octa = prepare(octahedron(), chain);
  CHECK(octa.truncated_vertices == 6);
  REQUIRE(octa.body.has_value());
  CHECK(octa.body->planes.size() == 14);
  CHECK(octa.max_displacement < 1e-9);
}
