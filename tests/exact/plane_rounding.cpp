// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/plane_body.hpp"

#include "exact/honeycomb_golden.hpp"
#include "hexact/exact/snapped_honeycomb.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

namespace hexact {
namespace {

/// Every coordinate is the nearest double of the exact one, and max_rounding bounds every distance.
void check_rounding(const PlaneBody& body) {
  const RoundedVertices rounded = rounded_vertices(body);
  REQUIRE(rounded.points.size() == body.vertex_count());
  const Rational bound = Rational::from_double(rounded.max_rounding);
  Rational largest(0);
  for (std::size_t v = 0; v < body.vertex_count(); ++v) {
    const auto p = rational_vertex(body, make_id<VertexId>(v));
    const auto& r = rounded.points[v];
    REQUIRE(r.x == p.x.to_double());
    REQUIRE(r.y == p.y.to_double());
    REQUIRE(r.z == p.z.to_double());
    const Rational x = p.x - Rational::from_double(r.x), y = p.y - Rational::from_double(r.y), z = p.z - Rational::from_double(r.z);
    largest = std::max(largest, x * x + y * y + z * z);
  }
  CHECK(largest <= bound * bound);
  // Tight: not more than a millionth above the truth.
  CHECK(bound * bound <= largest * Rational(Integer(1000001), Integer(1000000)));
}

TEST_CASE("snapped levels are rounded correctly, with and without scale and shift", "[rounding]") {
  auto level = snapped_start(test::body_of(test::tetrahedron()));
  for (int l = 0; l < 6; ++l) level = snapped_step(std::move(level), static_policy_rational(), {}).level;
  PlaneBody body = to_plane_body(level);
  check_rounding(body);
  body.scale += 40;
  body.shift = {Rational::from_double(0.1), Rational::from_double(-1e6), Rational(0)};
  check_rounding(body);
  body.shift = {Rational::from_double(0.1).scaled(-600), Rational::from_double(1) + Rational(1).scaled(-80), Rational(0)};
  check_rounding(body);
}

TEST_CASE("exact levels with wide planes are rounded correctly", "[rounding]") {
  auto level = honeycomb_start<Rational>(test::body_of(test::cube()));
  for (int l = 0; l < 5; ++l) level = honeycomb_step(level, static_policy_rational()).level;
  check_rounding(to_plane_body(level));
}

/// One vertex at (p/q, 0, 0) made of the planes qx <= p, y <= 0, z <= 0.
PlaneBody one_vertex(std::int64_t p, std::int64_t q) {
  PlaneBody body;
  body.planes.push_back(IntegerPlanes::Narrow{q, 0, 0, p});
  body.planes.push_back(IntegerPlanes::Narrow{0, 1, 0, 0});
  body.planes.push_back(IntegerPlanes::Narrow{0, 0, 1, 0});
  body.triples.push_back({FacetId{0}, FacetId{1}, FacetId{2}});
  return body;
}

TEST_CASE("ties go to the even neighbour and near-ties do not", "[rounding]") {
  const std::int64_t one = std::int64_t{1} << 54;
  CHECK(rounded_vertices(one_vertex(one + 2, 1)).points[0].x == std::ldexp(1.0, 54));
  CHECK(rounded_vertices(one_vertex(one + 6, 1)).points[0].x == std::ldexp(1.0, 54) + 8);
  // 2^53 + 1 + 1/3 is above the tie, 2^53 + 1 − 1/3 below.
  const std::int64_t tie = (std::int64_t{1} << 53) + 1;
  CHECK(rounded_vertices(one_vertex(3 * tie + 1, 3)).points[0].x == std::ldexp(1.0, 53) + 2);
  CHECK(rounded_vertices(one_vertex(3 * tie - 1, 3)).points[0].x == std::ldexp(1.0, 53));
  std::mt19937_64 random(53);
  for (int i = 0; i < 2000; ++i) {
    const auto q = static_cast<std::int64_t>(random() % (1U << 30)) + 1;
    const auto p = static_cast<std::int64_t>(random() >> (2 + random() % 50));
    PlaneBody body = one_vertex(i % 2 == 0 ? p : -p, q);
    body.scale = static_cast<long>(random() % 2000) - 1000;
    const double exact = Rational(Integer(i % 2 == 0 ? p : -p), Integer(q)).scaled(body.scale).to_double();
    if (!std::isfinite(exact)) continue;
    REQUIRE(rounded_vertices(body).points[0].x == exact);
  }
}

TEST_CASE("vertices without a point and coordinates beyond the doubles are refused", "[rounding]") {
  PlaneBody flat = one_vertex(1, 1);
  flat.planes.set(0, IntegerPlanes::Narrow{0, 1, 1, 5});
  CHECK_THROWS_AS(rounded_vertices(flat), InvalidInput);
  CHECK_THROWS_AS(rational_vertex(flat, VertexId{0}), InvalidInput);
  PlaneBody far = one_vertex(1, 1);
  far.scale = 1024;
  CHECK_THROWS_AS(rounded_vertices(far), ResourceLimit);
}

TEST_CASE("what doubles hold is known to be exact", "[rounding]") {
  for (const auto& [p, q] : {std::pair<std::int64_t, std::int64_t>{1, 1}, {-7, 4}, {15, 3}, {(std::int64_t{1} << 50) + 1, 1}, {21, 7}}) {
    CAPTURE(p, q);
    CHECK(rounded_vertices(one_vertex(p, q)).max_rounding == 0);
    PlaneBody moved = one_vertex(p, q);
    moved.shift[0] = Rational(1) / Rational(2);
    CHECK(rounded_vertices(moved).max_rounding == 0);
    moved.shift[0] = Rational(1).scaled(-80);  // beyond the last bit: off by just that
    CHECK(rounded_vertices(moved).max_rounding > 0);
    check_rounding(moved);
  }
  CHECK(rounded_vertices(one_vertex(1, 3)).max_rounding > 0);
  check_rounding(one_vertex(1, 3));
  check_rounding(one_vertex((std::int64_t{1} << 60) + 1, 1));
}

TEST_CASE("vertices over Q(sqrt5) are rounded correctly", "[rounding]") {
  const nlohmann::json data = test::golden();
  const test::Solid dodecahedron = test::solid(data.at("closed")[2].at("initial"));
  const PlaneBody body = test::body_of(dodecahedron);
  REQUIRE(body.field == Field::sqrt5);
  const RoundedVertices rounded = rounded_vertices(body);
  for (std::size_t v = 0; v < body.vertex_count(); ++v) {
    CHECK(sqrt5_vertex(body, make_id<VertexId>(v)) == dodecahedron.points[v]);
    CHECK(rounded.points[v].x == dodecahedron.points[v].x.to_double());
  }
  CHECK(rounded.max_rounding > 0);
  CHECK(rounded.max_rounding < 1e-15);
}

}  // namespace
}  // namespace hexact
