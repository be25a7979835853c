// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/snapped_honeycomb.hpp"
#include "solid_samples.hpp"

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include <cmath>
#include <initializer_list>
#include <limits>

using namespace hexact;

namespace {

PlaneBody body(std::initializer_list<IntegerPlanes::Narrow> planes, std::initializer_list<std::initializer_list<int>> loops,
               std::size_t vertices) {
  PlaneBody b;
  for (const auto& p : planes) {
    b.planes.push_back(p);
    b.addresses.push_back({});
  }
  for (const auto& loop : loops) {
    for (const int v : loop) b.loops.add_corner(make_id<VertexId>(static_cast<std::size_t>(v)));
    b.loops.close_loop();
  }
  b.triples.resize(vertices);
  return b;
}

PlaneBody cube() {
  return body({{-1, 0, 0, 1}, {1, 0, 0, 1}, {0, -1, 0, 1}, {0, 1, 0, 1}, {0, 0, -1, 1}, {0, 0, 1, 1}},
              {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}, 8);
}

PlaneBody tetrahedron() {
  return body({{-1, -1, -1, 1}, {-1, 1, 1, 1}, {1, -1, 1, 1}, {1, 1, -1, 1}}, {{3, 2, 1}, {2, 3, 0}, {3, 1, 0}, {1, 2, 0}},
              4);
}

/// A combinatorial cube without symmetry.
PlaneBody generic_cube() {
  return body({{-41, 3, -7, 40}, {43, -5, 2, 44}, {4, -39, 6, 41}, {-3, 45, 8, 43}, {5, -2, -42, 39}, {-6, 7, 44, 45}},
              {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}, 8);
}

CutPolicy tangent_to_sphere(double radius) {
  return PlanePolicy{[](const CornerView& view) {
                       std::array<double, 3> n{};
                       for (const auto& u : view.unit_normals)
                         for (std::size_t k = 0; k < 3; ++k) n[k] += u[k];
                       return n;
                     },
                     [radius](const std::array<double, 3>& n) {
                       return radius * std::sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
                     }};
}

double largest_angle(const SnappedLevel& level) {
  double smallest = 1;
  for (std::uint32_t h = 0; h < level.map.half_edge_count(); ++h) {
    const auto& p = level.planes.narrow(level.map.facet(h));
    const auto& q = level.planes.narrow(level.map.facet(level.map.twin(h)));
    double pq = 0, pp = 0, qq = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      pq += static_cast<double>(p[k]) * static_cast<double>(q[k]);
      pp += static_cast<double>(p[k]) * static_cast<double>(p[k]);
      qq += static_cast<double>(q[k]) * static_cast<double>(q[k]);
    }
    smallest = std::min(smallest, pq / std::sqrt(pp * qq));
  }
  return std::acos(smallest) * 180 / std::acos(-1.0);
}

bool same_planes(const IntegerPlanes& a, const IntegerPlanes& b, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    if (!(a[i] == b[i])) return false;
  }
  return true;
}

struct Case {
  const char* name;
  PlaneBody (*base)();
  int levels;
};

Rational det(const Rational& a, const Rational& b, const Rational& c, const Rational& d, const Rational& e,
             const Rational& f, const Rational& g, const Rational& h, const Rational& i) {
  return a * (e * i - f * h) - b * (d * i - f * g) + c * (d * h - e * g);
}

/// n·x − d of a plane at a vertex by Cramer's rule, straight from the definition.
Rational height(const HoneycombMap& map, const IntegerPlanes& planes, std::size_t plane, std::uint32_t v) {
  const auto facets = map.facets_at(v);
  const Plane<Integer> p = planes[facets[0]], q = planes[facets[1]], r = planes[facets[2]], n = planes[plane];
  const Rational w = det(p.a, p.b, p.c, q.a, q.b, q.c, r.a, r.b, r.c);
  const Rational x = det(p.d, p.b, p.c, q.d, q.b, q.c, r.d, r.b, r.c) / w;
  const Rational y = det(p.a, p.d, p.c, q.a, q.d, q.c, r.a, r.d, r.c) / w;
  const Rational z = det(p.a, p.b, p.d, q.a, q.b, q.d, r.a, r.b, r.d) / w;
  return Rational(n.a) * x + Rational(n.b) * y + Rational(n.c) * z - Rational(n.d);
}

}  // namespace

TEST_CASE("snapped levels of the cube, the tetrahedron and a generic cube are certified", "[snapped]") {
  const Case test = GENERATE(Case{"cube", cube, 9}, Case{"tetrahedron", tetrahedron, 9}, Case{"generic cube", generic_cube, 8});
  CAPTURE(test.name);
  SnappedLevel level = snapped_start(test.base());
  REQUIRE(sign_violations(level.map, level.planes).empty());
  const CutPolicy policy = static_policy_rational();
  for (int l = 1; l <= test.levels; ++l) {
    CAPTURE(l);
    const std::size_t facets = level.map.facet_count(), vertices = level.map.vertex_count();
    const IntegerPlanes before = level.planes;
    SnappedStep step = snapped_step(std::move(level), policy, {});
    level = std::move(step.level);
    CHECK(level.map.facet_count() == facets + vertices);
    CHECK(level.map.vertex_count() == 3 * vertices);
    CHECK(same_planes(before, level.planes, facets));
    CHECK(sign_violations(level.map, level.planes).empty());
    CHECK(step.figures.min_parameter >= 0);
    CHECK(step.figures.max_parameter_change < 1.0 / 64);
    CHECK(step.figures.delta > 0);
  }
}

TEST_CASE("the realised parameters are exact rationals not below those asked", "[snapped]") {
  SnappedLevel before = snapped_start(tetrahedron());
  const SizePolicy sizes = static_policy_rational();
  for (int l = 1; l <= 5; ++l) {
    const SnappedStep step = snapped_step(before, CutPolicy(sizes), {});
    Rational largest(0), smallest(1);
    for (std::uint32_t v = 0; v < before.map.vertex_count(); ++v) {
      const std::size_t plane = before.map.facet_count() + v;
      const Rational own = height(before.map, step.level.planes, plane, v);
      REQUIRE(own.sign() > 0);
      for (const std::uint32_t h : before.map.star(v)) {
        const Rational other = height(before.map, step.level.planes, plane, before.map.target(h));
        const Rational realised = -other / (own - other);
        const Rational change = realised - asked_parameter(before.map, sizes, h).rational_part();
        REQUIRE(change.sign() >= 0);
        largest = std::max(largest, change);
        smallest = std::min(smallest, realised);
      }
    }
    CHECK(largest <= Rational::from_double(step.figures.max_parameter_change));
    CHECK(smallest >= Rational::from_double(step.figures.min_parameter));
    before = step.level;
  }
}

TEST_CASE("planes near collapsing edges, chosen in words or big integers, keep the same promise", "[snapped]") {
  SnappedLevel before = snapped_start(tetrahedron());
  const SizePolicy sizes = static_policy_rational();
  std::size_t choices = 0, tested = 0, wide = 0;
  for (int l = 1; l <= 11; ++l) {  // edges of 2e-26
    const SnappedStep step = snapped_step(before, CutPolicy(sizes), {});
    choices += step.figures.exact_choices;
    const Rational largest = Rational::from_double(step.figures.max_parameter_change);
    for (std::uint32_t v = 0, found = 0; v < before.map.vertex_count(); ++v) {
      const std::size_t plane = before.map.facet_count() + v;
      const bool is_wide = !step.level.planes.is_narrow(plane);
      const auto is_long = [](std::int64_t x) { return x >= (std::int64_t{1} << 38) || x <= -(std::int64_t{1} << 38); };
      if (!is_wide && !is_long(step.level.planes.narrow(plane)[0])) continue;
      if (found++ % 13 != 0) continue;
      ++tested;
      wide += is_wide ? 1 : 0;
      const Rational own = height(before.map, step.level.planes, plane, v);
      REQUIRE(own.sign() > 0);
      for (const std::uint32_t h : before.map.star(v)) {
        const Rational other = height(before.map, step.level.planes, plane, before.map.target(h));
        const Rational change = -other / (own - other) - asked_parameter(before.map, sizes, h).rational_part();
        REQUIRE(change.sign() >= 0);
        REQUIRE(change <= largest);
      }
    }
    before = step.level;
  }
  CHECK(choices > 1000);
  CHECK(tested > 100);
  CHECK(wide > 10);
}

TEST_CASE("planes tangent to the inscribed sphere become smooth on the cube and are refused on the tetrahedron", "[snapped]") {
  SnappedLevel level = snapped_start(cube());
  std::vector<double> angles;
  for (int l = 1; l <= 6; ++l) {
    level = snapped_step(std::move(level), tangent_to_sphere(1), {}).level;
    REQUIRE(sign_violations(level.map, level.planes).empty());
    angles.push_back(largest_angle(level));
  }
  CHECK(angles[2] == Approx(23.87).margin(0.01));
  CHECK(angles[3] == Approx(13.48).margin(0.01));
  CHECK(angles[4] == Approx(7.97).margin(0.01));

  const SnappedStep step = snapped_step(snapped_start(tetrahedron()), tangent_to_sphere(1 / std::sqrt(3.0)), {});
  CHECK_FALSE(sign_violations(step.level.map, step.level.planes).empty());
}

TEST_CASE("inadmissible parameters are named before anything is computed", "[snapped]") {
  const auto constant = [](int p, int q) {
    return CutPolicy(SizePolicy{{QuadraticField(Rational(Integer(p), Integer(q)))}});
  };
  const auto code = [](const PlaneBody& base, const CutPolicy& policy) -> std::string {
    try {
      (void)snapped_step(snapped_start(base), policy, {});
      return "";
    } catch (const InvalidInput& e) {
      return e.code();
    }
  };
  CHECK(code(cube(), constant(0, 1)) == "QuadCollapse");
  CHECK(code(cube(), constant(1, 1000)) == "");
  CHECK(code(cube(), constant(1, 2)) == "ParameterOutOfRange");
  CHECK(code(cube(), constant(-1, 10)) == "ParameterOutOfRange");
  CHECK(code(tetrahedron(), constant(1, 3)) == "TriangleOvercut");
  CHECK(code(tetrahedron(), constant(3, 10)) == "TriangleOvercut");
  CHECK(code(tetrahedron(), constant(334, 1000)) == "");
}

TEST_CASE("a bound on bits ends the work with the level and the vertex", "[snapped]") {
  SnappedLevel level = snapped_start(tetrahedron());
  SnappedOptions options;
  options.max_bits = 24;
  std::string message;
  try {
    for (int l = 1; l <= 11; ++l) level = snapped_step(std::move(level), CutPolicy(static_policy_rational()), options).level;
  } catch (const ResourceLimit& e) {
    message = e.what();
  }
  CHECK_THAT(message, Catch::Contains("level") && Catch::Contains("vertex") && Catch::Contains("24"));
}

TEST_CASE("the planes do not depend on the number of threads", "[snapped]") {
  const auto run = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    SnappedLevel level = snapped_start(tetrahedron());
    for (int l = 1; l <= 9; ++l) level = snapped_step(std::move(level), CutPolicy(static_policy_rational()), {}).level;
    return level;
  };
  const SnappedLevel one = run(1), two = run(2);
  CHECK(same_planes(one.planes, two.planes, one.planes.size()));
  CHECK(one.points == two.points);
  CHECK(one.errors == two.errors);
}

TEST_CASE("a body far from the origin is refined in a shifted frame", "[snapped]") {
  PlaneBody far = cube();
  far.shift = {Rational(1000000000), Rational(-3), Rational(0)};
  PlaneBody moved = cube();
  moved.planes.set(0, IntegerPlanes::Narrow{-1, 0, 0, -999999});
  moved.planes.set(1, IntegerPlanes::Narrow{1, 0, 0, 1000001});
  for (const PlaneBody& base : {far, moved}) {
    SnappedLevel level = snapped_start(base);
    for (int l = 1; l <= 4; ++l) level = snapped_step(std::move(level), CutPolicy(static_policy_rational()), {}).level;
    CHECK(sign_violations(level.map, level.planes).empty());
    for (const auto& p : level.points) CHECK(std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)}) <= 0x1p18);
  }
}

TEST_CASE("each kind of sign violation is found and explained", "[snapped]") {
  const HoneycombMap map(cube().loops, 8);
  IntegerPlanes good = cube().planes;
  REQUIRE(sign_violations(map, good).empty());
  IntegerPlanes inverted = good;
  inverted.set(5, IntegerPlanes::Narrow{0, 0, -1, -1});
  CHECK(explain(sign_violations(map, inverted).front(), map).code == "NotConvex");
  IntegerPlanes crossed = good;
  crossed.set(5, IntegerPlanes::Narrow{0, 0, 1, -2});
  const auto violations = sign_violations(map, crossed);
  REQUIRE_FALSE(violations.empty());
  CHECK(violations.front().kind == SignViolation::Kind::edge);
}

TEST_CASE("signs by points and signs by planes agree, on good levels and on broken ones", "[snapped]") {
  for (const PlaneBody& base : {samples::cube(), samples::tetrahedron(), samples::generic_dodecahedron()}) {
    SnappedLevel level = snapped_start(base);
    for (int k = 0; k < 5; ++k) {
      CHECK(sign_violations(level).empty());
      CHECK(sign_violations(level.map, level.planes).empty());
      // A plane that is moved breaks corners, edges or nothing; both ways have to say the same, from stale points too.
      for (std::size_t f = 0; f < level.planes.size(); f += level.planes.size() / 5 + 1) {
        SnappedLevel moved{level.map, level.planes, {}, {}, 0, {}};
        Plane<Integer> p = level.planes[f];
        p.d = p.d - floor_quotient(p.d, Integer(8));
        moved.planes.set(f, p);
        moved.points.resize(level.points.size());
        moved.errors.resize(level.errors.size());
        std::fill(moved.points.begin(), moved.points.end(), Point3<double>{});
        std::fill(moved.errors.begin(), moved.errors.end(), std::numeric_limits<float>::infinity());
        CHECK(sign_violations(moved).empty() == sign_violations(moved.map, moved.planes).empty());
      }
      level = snapped_step(std::move(level), static_policy_rational(), {}).level;
    }
  }
}

TEST_CASE("points of deep levels are within their proven errors, and their det3 positive", "[snapped]") {
  SnappedLevel level = snapped_start(samples::tetrahedron());
  for (int k = 0; k < 10; ++k) level = snapped_step(std::move(level), static_policy_rational(), {}).level;  // edges of 1e-15
  const PlaneBody body = to_plane_body(level);
  for (std::uint32_t v = 0; v < level.map.vertex_count(); v += 37) {
    const Point3<Rational> exact = rational_vertex(body, make_id<VertexId>(v));
    REQUIRE(std::isfinite(level.errors[v]));
    const auto off = [&](const Rational& x, double y) { return abs(x.scaled(-level.scale) - Rational::from_double(y)); };
    const Rational bound = Rational::from_double(static_cast<double>(level.errors[v]));
    CHECK(off(exact.x - level.shift[0], level.points[v].x) <= bound);
    CHECK(off(exact.y - level.shift[1], level.points[v].y) <= bound);
    CHECK(off(exact.z - level.shift[2], level.points[v].z) <= bound);
    const auto t = body.triples[v];
    CHECK(samples::det(body.planes[index(t[0])], body.planes[index(t[1])], body.planes[index(t[2])]).sign() > 0);
  }
}
