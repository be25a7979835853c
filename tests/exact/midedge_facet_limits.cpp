// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/midedge_facet_limits.hpp"

#include "hexact/exact/midedge_boundary_limit.hpp"
#include "midedge_samples.hpp"

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include <numeric>

using namespace hexact;
using namespace hexact::midedge_samples;

namespace {

constexpr MidedgeRule kRules[] = {MidedgeRule::simple, MidedgeRule::six_point};
constexpr MidedgeBoundary kPolicies[] = {MidedgeBoundary::dual, MidedgeBoundary::close};
using Limits = std::vector<std::optional<MidedgeLimit>>;

Limits limits_of(const Level& level, const MidedgeLimitPlan& plan, std::size_t count) {
  std::vector<std::uint32_t> facets(count);
  std::iota(facets.begin(), facets.end(), 0u);
  return midedge_facet_limits(level, plan, facets);
}

Level two_steps(const Level& level, const MidedgeLimitPlan& plan) {
  return plan.boundary == MidedgeBoundary::dual ? midedge_double_step(level, plan.rule) : refined(level, 2, plan.rule, plan.boundary);
}

Rational fraction(long p, long q) { return Rational(Integer(p), Integer(q)); }

Point mean(const Level& level, std::span<const std::uint32_t> vertices) {
  Point sum;
  for (const std::uint32_t v : vertices) sum = {sum.x + level.points[v].x, sum.y + level.points[v].y, sum.z + level.points[v].z};
  const Rational n(static_cast<long>(vertices.size()));
  return {sum.x / n, sum.y / n, sum.z / n};
}

bool at_boundary(const MidedgeMap& map, std::uint32_t f) { return touches_boundary(midedge_boundary_pattern(map, f)); }

/// The mesh seen from the other side.
Level turned(const Level& level) {
  std::vector<std::vector<int>> facets;
  for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) {
    const auto loop = level.map.loop(f);
    facets.emplace_back(loop.rbegin(), loop.rend());
  }
  return level_of({level.points.begin(), level.points.end()}, facets);
}

std::string refusal(const std::function<void()>& work) {
  try {
    work();
  } catch (const InvalidInput& e) {
    return e.code() + " " + e.findings().front().element;
  } catch (const ResourceLimit& e) {
    return std::string("ResourceLimit ") + e.what();
  }
  return "";
}

}  // namespace

TEST_CASE("limits of open meshes are the same numbers from every later level", "[midedge]") {
  auto samples = open_samples();
  samples.emplace("two components", beside(golden_mesh("cube"), grid(3, 2, wave)));
  for (const auto& [name, level] : samples) {
    for (const MidedgeRule rule : kRules) {
      for (const MidedgeBoundary policy : kPolicies) {
        CAPTURE(name, int(rule), int(policy));
        const MidedgeLimitPlan plan{rule, policy};
        const Level second = two_steps(level, plan), third = two_steps(second, plan);
        const std::size_t facets = level.map.facet_count(), more = std::min(facets + 20, second.map.facet_count());
        const Limits a = limits_of(level, plan, facets), b = limits_of(second, plan, more), c = limits_of(third, plan, more);
        for (std::size_t f = 0; f < c.size(); ++f) {
          REQUIRE((b[f] && c[f]));
          CHECK(b[f]->point == c[f]->point);
          CHECK(b[f]->normal.has_value() == c[f]->normal.has_value());
          if (f >= a.size()) continue;
          REQUIRE(a[f]);
          CHECK(a[f]->point == b[f]->point);
          // Normals: not at the boundary, which facets never leave under `dual` and always do under `close`.
          if (policy == MidedgeBoundary::dual && at_boundary(level.map, static_cast<std::uint32_t>(f))) CHECK_FALSE(a[f]->normal);
          if (rule == MidedgeRule::simple) CHECK(a[f]->point == mean(level, level.map.loop(static_cast<std::uint32_t>(f))));
        }
        if (name == "alone") CHECK(a[0]->point == mean(level, level.map.loop(0)));
        if (name == "grid") CHECK(a[0]->normal.has_value() == (policy == MidedgeBoundary::close));
      }
    }
  }
}

TEST_CASE("quadrilaterals around vertices of other valences have the limits of later levels", "[midedge]") {
  for (const MidedgeRule rule : kRules) {
    const Level cube = golden_mesh("cube");
    const Limits first = limits_of(cube, {rule}, 6), later = limits_of(refined(cube, 3, rule), {rule}, 6);
    for (std::size_t f = 0; f < 6; ++f) CHECK(first[f]->point == later[f]->point);
  }
}

TEST_CASE("drop: facets at the boundary and those that never get away from it have no limit", "[midedge]") {
  const Level level = grid(8, 7, wave);
  const Limits six = limits_of(level, {MidedgeRule::six_point, MidedgeBoundary::drop}, 56),
               dual = limits_of(level, {MidedgeRule::six_point, MidedgeBoundary::dual}, 56),
               simple = limits_of(level, {MidedgeRule::simple, MidedgeBoundary::drop}, 56);
  for (std::uint32_t f = 0; f < 56; ++f) {
    const std::uint32_t i = f % 8, j = f / 8;
    const bool inside = i >= 2 && i < 6 && j >= 2 && j < 5;
    REQUIRE(six[f].has_value() == inside);
    if (inside) CHECK(six[f]->point == dual[f]->point);
    CHECK(simple[f]->point == mean(level, level.map.loop(f)));
    CHECK(simple[f]->normal.has_value() != at_boundary(level.map, f));
  }
}

TEST_CASE("close: long runs of boundary vertices with two edges take as many steps, and are bounded", "[midedge]") {
  // An n-gon with a triangle on one side.
  const auto mesh = [](int n) {
    std::vector<Point> points;
    std::vector<std::vector<int>> facets(2);
    for (int i = 0; i < n; ++i) {
      points.push_back({i * i, 3 * i - i * i, i % 5});
      facets[0].push_back(i);
    }
    points.push_back({-3, -4, 2});
    facets[1] = {1, 0, n};
    return level_of(points, facets);
  };
  const MidedgeLimitPlan six{MidedgeRule::six_point, MidedgeBoundary::close}, simple{MidedgeRule::simple, MidedgeBoundary::close};
  const Level level = mesh(9);
  const Limits a = limits_of(level, six, 2), b = limits_of(refined(level, 3, MidedgeRule::six_point), six, 2);
  REQUIRE((a[0] && a[1] && b[0] && b[1]));
  CHECK((a[0]->point == b[0]->point && a[1]->point == b[1]->point));
  CHECK(a[0]->normal);
  // 201 vertices in a row: too many.
  const Level long_run = mesh(203);
  CHECK(limits_of(long_run, simple, 1)[0]->point == mean(long_run, long_run.map.loop(0)));
  CHECK_FALSE(limits_of(long_run, simple, 1)[0]->normal);
  CHECK(refusal([&] { (void)limits_of(long_run, six, 1); }).find("facet 0 has as many boundary vertices") != std::string::npos);
  CHECK(limits_of(mesh(60), simple, 1)[0]->normal);
  // The refusal names the smallest of several facets, in whatever order they are met.
  const Level two = beside(long_run, mesh(203));
  for (const std::vector<std::uint32_t>& facets : {std::vector<std::uint32_t>{2, 0, 1}, {1, 2, 3, 0}}) {
    CHECK(refusal([&] { (void)midedge_facet_limits(two, six, facets); }).find("facet 0 has as many") != std::string::npos);
  }
}

TEST_CASE("dual: the surface ends half a cell inside, at the middle of each boundary fan", "[midedge]") {
  for (const MidedgeRule rule : kRules) {
    const auto flat = [](const Rational& i, const Rational& j) { return Point{i, j, Rational(2) * i - Rational(3) * j}; };
    const int m = 5, n = 4;
    const std::vector<Point> limits =
        midedge_vertex_limits(grid(m, n, [&](int i, int j) { return flat(Rational(i), Rational(j)); }), {rule});
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= m; ++i) {
        const auto inside = [](int x, int last) { return x == 0 ? fraction(1, 2) : x == last ? Rational(last) - fraction(1, 2) : Rational(x); };
        CHECK(limits[static_cast<std::size_t>(j * (m + 1) + i)] == flat(inside(i, m), inside(j, n)));
      }
    }
  }
  // On data that is not flat: S(1/2, 1/2) is the limit of the corner's facet, S(1/2, j) that of the facet of the edge between
  // facets (0, j − 1) and (0, j), S(i, j) that of the facet of the vertex.
  const Level level = grid(4, 3, wave), next = midedge_double_step(level, MidedgeRule::six_point);
  const std::vector<Point> limits = midedge_vertex_limits(level, {});
  const Limits of_next = limits_of(next, {}, next.map.facet_count());
  CHECK(limits[0] == of_next[0]->point);
  const auto shares = [&](std::uint32_t f, std::size_t corner) { return next.map.loop(f)[corner % next.map.facet_size(f)]; };
  std::size_t found = 0;
  for (std::uint32_t f = 12; f < next.map.facet_count(); ++f) {
    std::vector<std::uint32_t> of;  // facets of the level whose corners f joins
    for (std::size_t c = 0; c < 4; ++c) of.push_back(shares(f, c) / 4);
    std::sort(of.begin(), of.end());
    if (of == std::vector<std::uint32_t>{0, 0, 4, 4}) found += limits[5] == of_next[f]->point ? 1 : 0;    // vertex (0, 1)
    if (of == std::vector<std::uint32_t>{0, 1, 4, 5}) found += limits[6] == of_next[f]->point ? 1 : 0;    // vertex (1, 1)
    if (of == std::vector<std::uint32_t>{2, 2, 3, 3}) found += limits[3] == of_next[f]->point ? 1 : 0;    // vertex (3, 0)
  }
  CHECK(found == 3);
  // Five facets around a boundary vertex: the third.
  const Level fan = open_samples().at("fan of 5");
  CHECK(midedge_vertex_limits(fan, {})[0] == limits_of(fan, {}, 5)[2]->point);
}

TEST_CASE("vertex limits do not depend on which side is outside, and commute with affine maps", "[midedge]") {
  auto samples = open_samples();
  samples.emplace("two components", beside(grid(3, 2, wave), golden_mesh("cube")));
  const auto map = [](const Point& p) { return Point{p.y - Rational(3) * p.x, p.z + Rational(7), p.x + fraction(1, 3) * p.z}; };
  for (const auto& [name, level] : samples) {
    Level mapped = level;
    for (Point& p : mapped.points) p = map(p);
    for (const MidedgeBoundary policy : kPolicies) {
      CAPTURE(name, int(policy));
      const MidedgeLimitPlan plan{MidedgeRule::six_point, policy};
      std::vector<Point> limits = midedge_vertex_limits(level, plan);
      CHECK(limits == midedge_vertex_limits(turned(level), plan));
      for (Point& p : limits) p = map(p);
      CHECK(limits == midedge_vertex_limits(mapped, plan));
    }
  }
}

TEST_CASE("close: boundary vertices go to the mean of their loop, which all levels share", "[midedge]") {
  const MidedgeLimitPlan plan{MidedgeRule::six_point, MidedgeBoundary::close};
  const Level level = beside(open_samples().at("hole"), golden_mesh("cube"));
  const std::vector<Point> limits = midedge_vertex_limits(level, plan);
  std::vector<std::uint32_t> outer, inner;
  for (std::uint32_t v = 0; v < 36; ++v) {
    const std::uint32_t i = v % 6, j = v / 6;
    if (i == 0 || i == 5 || j == 0 || j == 5) {
      outer.push_back(v);
    } else if (!(i == 1) && !(i == 4 && j == 1) && !(j == 4)) {
      inner.push_back(v);
    }
  }
  const auto closed = midedge_vertex_limits(golden_mesh("cube"), plan);
  for (const std::uint32_t v : outer) CHECK(limits[v] == mean(level, outer));
  for (std::size_t v = 0; v < 8; ++v) CHECK(limits[36 + v] == closed[v]);
  std::map<std::string, std::size_t> inner_points;
  for (const std::uint32_t v : inner) ++inner_points[limits[v].x.str() + " " + limits[v].y.str() + " " + limits[v].z.str()];
  std::size_t together = 0;
  for (const auto& [point, count] : inner_points) together = std::max(together, count);
  CHECK(together == 8);  // the hole of facets 7, 12, 13 has eight vertices
  // The mean of a loop is kept by every step.
  Level next = refined(open_samples().at("fan of 4"), 1, plan.rule, plan.boundary);
  for (int n = 0; n < 3; ++n) {
    const Level later = refined(next, 1, plan.rule, plan.boundary);
    const auto rim = [](const Level& l) {
      std::vector<std::uint32_t> vertices;
      for (std::uint32_t h = 0; h < l.map.half_edge_count(); ++h) {
        if (l.map.twin(h) == kNoTwin) vertices.push_back(l.map.origin(h));
      }
      return vertices;
    };
    CHECK(mean(next, rim(next)) == mean(later, rim(later)));
    next = later;
  }
}

TEST_CASE("thousands of facets that have to be refined further each have their own limit", "[midedge]") {
  // Copies of two triangles side by side, more than are refined together.
  constexpr int kCopies = 2100;
  std::vector<Point> points;
  std::vector<std::vector<int>> facets;
  for (int i = 0; i < kCopies; ++i) {
    for (const Point& p : {Point{0, 0, 0}, Point{3, 0, 1}, Point{1, 4, 0}, Point{5, 5, 2}}) points.push_back({p.x + Rational(i), p.y, p.z - Rational(2 * i)});
    facets.push_back({4 * i, 4 * i + 1, 4 * i + 2});
    facets.push_back({4 * i + 1, 4 * i + 3, 4 * i + 2});
  }
  const Level level = level_of(points, facets);
  const Limits limits = limits_of(level, {}, facets.size());
  for (std::size_t i = 0; i < kCopies; ++i) {
    for (std::size_t f = 0; f < 2; ++f) {
      REQUIRE(limits[2 * i + f]);
      const Point& p = limits[f]->point;
      const Rational shift(static_cast<long>(i));
      CHECK(limits[2 * i + f]->point == Point{p.x + shift, p.y, p.z - Rational(2) * shift});
    }
  }
  CHECK(limits[0]->point != limits[1]->point);
}

TEST_CASE("what cannot be limited is refused", "[midedge]") {
  const Level level = grid(4, 3, wave);
  CHECK(refusal([&] { (void)midedge_vertex_limits(level, {MidedgeRule::simple, MidedgeBoundary::drop}); }) == "HasBoundary edge 0-1");
  CHECK(refusal([&] { require_vertex_limits(level.map, MidedgeBoundary::drop); }) == "HasBoundary edge 0-1");
  CHECK_NOTHROW(require_vertex_limits(level.map, MidedgeBoundary::close));
  CHECK_NOTHROW(require_vertex_limits(golden_mesh("cube").map, MidedgeBoundary::drop));
  const Level fan = open_samples().at("fan of 4");
  for (const MidedgeBoundary policy : kPolicies) {
    CHECK(refusal([&] { (void)limits_of(fan, {MidedgeRule::six_point, policy, 8}, 4); }).starts_with("ResourceLimit limit points need further steps"));
  }
}

TEST_CASE("limits tell how far they are and end when they are asked to", "[midedge]") {
  Progress whole, ended;
  ended.cancel();
  const Level level = grid(4, 3, wave);
  std::vector<std::uint32_t> facets(12);
  std::iota(facets.begin(), facets.end(), 0u);
  for (const MidedgeBoundary policy : kPolicies) {
    for (const MidedgeRule rule : kRules) {
      CHECK_THROWS_AS(midedge_facet_limits(level, {rule, policy}, facets, ProgressPart(ended)), Cancelled);
      CHECK_THROWS_AS(midedge_vertex_limits(level, {rule, policy}, ProgressPart(ended)), Cancelled);
    }
  }
  CHECK_THROWS_AS(midedge_boundary_weights(midedge_boundary_pattern(level.map, 0), ProgressPart(ended)), Cancelled);
  CHECK(ended.fraction() == 0);
  (void)midedge_facet_limits(level, {}, facets, ProgressPart(whole));
  CHECK(whole.fraction() == 1);
}

TEST_CASE("limits of open meshes do not depend on the number of threads", "[midedge]") {
  const auto run = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return midedge_vertex_limits(grid(20, 15, wave), {});
  };
  CHECK(run(1) == run(2));
}
