// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/policies.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <set>

using namespace hexact;

namespace {

PlaneBody cube() {
  PlaneBody b;
  for (const auto& p : {IntegerPlanes::Narrow{-1, 0, 0, 1}, {1, 0, 0, 1}, {0, -1, 0, 1}, {0, 1, 0, 1}, {0, 0, -1, 1}, {0, 0, 1, 1}}) {
    b.planes.push_back(p);
  }
  for (const auto& loop : {std::initializer_list<int>{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
    for (const int v : loop) b.loops.add_corner(make_id<VertexId>(static_cast<std::size_t>(v)));
    b.loops.close_loop();
  }
  b.addresses.resize(6);
  b.triples.resize(8);
  return b;
}

QuadraticField q(long p, long r) { return QuadraticField(Rational(Integer(p), Integer(r))); }

const SizePolicy& sizes(const CutPolicy& policy) { return std::get<SizePolicy>(policy); }

CutPolicy parsed(std::string_view text, Arithmetic arithmetic = Arithmetic::snapped) {
  const PlaneBody base = cube();
  return parse_policy(text, arithmetic, base)(HoneycombMap(base.loops, 8));
}

}  // namespace

TEST_CASE("the textual policies give the documented parameters", "[policies]") {
  CHECK(sizes(parsed("static")).for_size(3) == q(2, 5));
  CHECK(sizes(parsed("static")).for_size(4) == q(1, 4));
  CHECK(sizes(parsed("static")).for_size(5) == q(11, 97));
  CHECK(sizes(parsed("static", Arithmetic::qsqrt5)).for_size(5) ==
        QuadraticField(Rational(Integer(11), Integer(38)), Rational(Integer(-3), Integer(38))));
  CHECK(sizes(parsed("static")).for_size(9) == q(0, 1));
  CHECK(sizes(parsed("constant=0.25")).for_size(7) == q(1, 4));
  const SizePolicy listed = sizes(parsed("constant=3:2/5,4:1/4,6:0"));
  CHECK(listed.for_size(3) == q(2, 5));
  CHECK(listed.for_size(5) == q(1, 4));
  CHECK(listed.for_size(6) == q(0, 1));
  CHECK(listed.for_size(12) == q(0, 1));
}

TEST_CASE("the equal-u policy makes u equal for all facet sizes", "[policies]") {
  const auto n0 = static_cast<std::size_t>(GENERATE(6, 7, 8, 10));
  const SizePolicy policy = equal_u_policy(n0);
  const double pi = std::acos(-1.0);
  const double expected = 1 / std::pow(2 * std::cos(pi / static_cast<double>(n0)), 2);
  for (std::size_t n = 3; n <= n0; ++n) {
    const double beta = policy.for_size(n).to_double();
    const double u = (1 - 2 * beta) / (1 - beta) / std::pow(2 * std::cos(pi / static_cast<double>(n)), 2);
    CHECK(u == Approx(expected).epsilon(1e-10));
    CHECK((policy.for_size(n) * QuadraticField(Rational(1).scaled(40) * Rational(5))).rational_part().denominator() == Integer(1));
  }
  if (n0 == 6) CHECK(policy.for_size(3) == q(2, 5));
  if (n0 == 6) CHECK(policy.for_size(4) == q(1, 4));
}

TEST_CASE("texts that name no policy are rejected", "[policies]") {
  const char* text = GENERATE("", "statics", "constant", "constant=", "constant=x", "constant=3:", "constant=2:1/4",
                              "constant=3:1/4,3:1/5", "constant=1/0", "constant=nan", "random", "random=-1", "random=1x",
                              "tangent=cone", "constant=1/4+1/5*sqrt5");
  CAPTURE(text);
  CHECK_THROWS_AS(parsed(text), InvalidInput);
}

TEST_CASE("edge ranks follow the lexicographic order of the vertices", "[policies]") {
  HoneycombMap map(cube().loops, 8);
  for (int level = 0; level < 4; ++level, map = map.refined()) {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
      if (map.origin(h) < map.target(h)) edges.emplace_back(map.origin(h), map.target(h));
    }
    std::sort(edges.begin(), edges.end());
    const auto ranks = edge_ranks(map);
    for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
      const std::uint32_t a = map.origin(h), b = map.target(h);
      REQUIRE((edges[ranks[h]] == std::pair(std::min(a, b), std::max(a, b))));
    }
  }
}

TEST_CASE("random parameters are symmetric, admissible and depend on the seed", "[policies]") {
  HoneycombMap map = HoneycombMap(cube().loops, 8).refined().refined();
  const CutPolicy policy = random_policy(map, 42);
  std::set<std::string> values;
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    const QuadraticField x = asked_parameter(map, policy, h);
    CHECK(x == asked_parameter(map, policy, map.twin(h)));
    CHECK((x > QuadraticField(0) && x < q(1, 2)));
    values.insert(x.str());
  }
  CHECK(values.size() > 50);
  CHECK(condition_violations(map, policy).empty());
  CHECK_FALSE(asked_parameter(map, CutPolicy(random_policy(map, 43)), 0) == asked_parameter(map, policy, 0));
}

TEST_CASE("the fitted bodies touch a box as they should", "[policies]") {
  const Ellipsoid sphere = fitted_sphere(cube());
  for (const auto& n : {std::array<double, 3>{1, 0, 0}, {0, 0, -2}, {3, 4, 0}}) {
    CHECK(sphere.support(n) == Approx(std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2])));
  }
  PlaneBody box = cube();
  box.planes.set(1, IntegerPlanes::Narrow{1, 0, 0, 3});
  const Ellipsoid ellipsoid = fitted_ellipsoid(box);
  CHECK(ellipsoid.support({1, 0, 0}) == Approx(3).epsilon(0.01));
  CHECK(ellipsoid.support({-1, 0, 0}) == Approx(1).epsilon(0.01));
  CHECK(ellipsoid.support({0, 1, 0}) == Approx(1).epsilon(0.01));
  CHECK(ellipsoid.support({1, 0, 0}) <= 3 * (1 + 1e-12));
}
