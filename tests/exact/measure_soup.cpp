// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/measure_soup.hpp"

#include "soup_fixtures.hpp"

#include <catch2/catch.hpp>

#include <cmath>

using namespace hexact;
using namespace hexact::fixtures;

namespace {
std::optional<bool> convex(const PolygonSoup<Rational>& soup) { return bounds_convex_body(soup, examine_soup(soup)); }
}  // namespace

TEST_CASE("area, box and nonplanarity of simple meshes", "[measure]") {
  const SoupMeasures m = measure_soup(cube());
  CHECK(m.planar);
  CHECK(m.max_nonplanarity == 0);
  CHECK(m.area == 24);
  CHECK(m.box[0] == Point3<double>{-1, -1, -1});
  CHECK(m.box[1] == Point3<double>{1, 1, 1});
  // The square (±1, ±1) with corners at heights +h, −h, +h, −h: area vector (0, 0, 4), distance h.
  const Rational h = fraction(1, 8);
  const auto bent = soup_of({{1, 1, h}, {-1, 1, -h}, {-1, -1, h}, {1, -1, -h}}, {{0, 1, 2, 3}});
  CHECK_FALSE(measure_soup(bent).planar);
  CHECK(measure_soup(bent).max_nonplanarity == 0.125);
  CHECK(measure_soup(bent).area == 4);
}

TEST_CASE("the smallest bend is seen, and magnitudes up to the ends of the doubles", "[measure]") {
  PolygonSoup<Rational> soup = cube();
  soup.points[7] = {Rational(1) + Rational(1).scaled(-3000), 1, 1};
  CHECK_FALSE(measure_soup(soup).planar);
  CHECK(measure_soup(soup).max_nonplanarity > 0);
  for (long e : {500L, -500L}) {
    PolygonSoup<Rational> scaled = cube();
    for (auto& p : scaled.points) p = {p.x.scaled(e), p.y.scaled(e), p.z.scaled(e)};
    CHECK(measure_soup(scaled).area == std::ldexp(24.0, static_cast<int>(2 * e)));
  }
  for (auto& p : soup.points) p = {p.x.scaled(600), p.y.scaled(600), p.z.scaled(600)};
  CHECK_THROWS_AS(measure_soup(soup), ResourceLimit);
}

TEST_CASE("a collinear triangle is planar and has no area", "[measure]") {
  const auto line = soup_of({{0, 0, 0}, {1, 1, 1}, {3, 3, 3}}, {{0, 1, 2}});
  CHECK(measure_soup(line).planar);
  CHECK(measure_soup(line).area == 0);
  CHECK_FALSE(measure_soup(PolygonSoup<Rational>()).planar);
}

TEST_CASE("convex bodies, with flat edges, open meshes and dents", "[measure]") {
  CHECK(convex(cube()) == true);
  CHECK(convex(triangulated_cube()) == true);
  CHECK(convex(octahedron()) == true);
  PolygonSoup<Rational> dented = octahedron();
  dented.points[5].z = fraction(1, 2);
  CHECK(convex(dented) == false);
  PolygonSoup<Rational> open = cube();
  open.facets = FacetLoops();
  open.facets.add(cube().facets[0]);
  CHECK(convex(open) == std::nullopt);
  PolygonSoup<Rational> bent = cube();
  bent.points[7] = {2, 2, 2};
  CHECK(convex(bent) == false);
}

TEST_CASE("the area of a sliver whose square underflows next to its length", "[measure]") {
  PolygonSoup<Rational> soup;
  Rational far;
  REQUIRE(Rational::parse("1e308", far) == Rational::ParseResult::ok);
  soup.points = {{Rational(0), Rational(0), Rational(0)}, {Rational(1), Rational(0), far}, {Rational(0), Rational(1), Rational(1)}};
  const std::vector<VertexId> loop = {make_id<VertexId>(0), make_id<VertexId>(1), make_id<VertexId>(2)};
  soup.facets.add(loop);
  CHECK(measure_soup(soup).area == Approx(0.5e308));
}
