// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/midedge_limit.hpp"

#include "hexact/exact/midedge_facet_limits.hpp"
#include "midedge_samples.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <map>
#include <tuple>

using namespace hexact;
using namespace hexact::midedge_samples;

namespace {

constexpr MidedgeRule kRules[] = {MidedgeRule::simple, MidedgeRule::six_point};

Rational fraction(long p, long q) { return Rational(Integer(p), Integer(q)); }

MidedgeLimits prepared(MidedgeRule rule, const MidedgeMap& map) {
  MidedgeLimits limits(rule);
  for (const auto& [size, count] : facet_sizes(map)) limits.prepare(static_cast<std::uint32_t>(size));
  return limits;
}

double distance(const Point3<double>& a, const Point3<double>& b) { return std::hypot(a.x - b.x, a.y - b.y, a.z - b.z); }

/// Steps of a closed mesh until all facets that it has now have their two rings.
Level isolated(Level level, MidedgeRule rule) {
  const auto waiting = [&, facets = level.map.facet_count()] {
    for (std::uint32_t f = 0; f < facets; ++f) {
      if (midedge_net(level.map, f).empty()) return true;
    }
    return false;
  };
  while (waiting()) level = midedge_step(level, rule, MidedgeBoundary::close);
  return level;
}

}  // namespace

TEST_CASE("the weights of facet centres are those of the reference and add up to 1", "[midedge]") {
  const auto& expected = golden().at("limit_masks").at("face_centre_w_times_243712");
  int sum = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      CHECK(midedge_centre_weights()[i][j] == expected[i][j]);
      sum += midedge_centre_weights()[i][j];
    }
  }
  CHECK(sum == 243712);
}

TEST_CASE("limits and normals are the same from every later level", "[midedge]") {
  // With w a left eigenvector for 1 and l one for λ, points agree exactly and directions up to the bounds.
  for (const int n : {3, 5, 6, 7, 9}) {
    for (const MidedgeRule rule : kRules) {
      const Level first = isolated(tower(n), rule), second = refined(first, 2, rule);
      const MidedgeLimits limits = prepared(rule, second.map);
      for (std::uint32_t f = 0; f < 2 * static_cast<std::uint32_t>(n) + 1; ++f) {
        const auto a = limits(first, f), b = limits(second, f);
        REQUIRE((a && b));
        CHECK(a->point == b->point);
        if (rule == MidedgeRule::simple && first.map.facet_size(f) == 3) {
          CHECK_FALSE(a->normal);
          continue;
        }
        REQUIRE((a->normal && b->normal));
        CHECK(a->normal->bound < 1e-14);
        CHECK(distance(a->normal->unit, b->normal->unit) <= a->normal->bound + b->normal->bound);
        CHECK(a->normal->exact.has_value() == (first.map.facet_size(f) == 4));
      }
    }
  }
}

TEST_CASE("normals of levels tend to the limit normals, points to the limit points", "[midedge]") {
  const Level base = isolated(tower(5), MidedgeRule::six_point);
  const MidedgeLimits limits = prepared(MidedgeRule::six_point, base.map);
  MidedgeLevel<double> level = in_doubles(base);
  for (int n = 0; n < 10; ++n) level = midedge_step(level, MidedgeRule::six_point, MidedgeBoundary::close);
  for (std::uint32_t f = 0; f < 11; ++f) {
    const auto limit = limits(base, f);
    REQUIRE((limit && limit->normal));
    Point3<double> centre{0, 0, 0}, normal{0, 0, 0};
    const auto loop = level.map.loop(f);
    const auto k = static_cast<double>(loop.size());
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const auto &p = level.points[loop[i]], &q = level.points[loop[(i + 1) % loop.size()]];
      centre = {centre.x + p.x / k, centre.y + p.y / k, centre.z + p.z / k};
      normal = {normal.x + (p.y - q.y) * (p.z + q.z), normal.y + (p.z - q.z) * (p.x + q.x), normal.z + (p.x - q.x) * (p.y + q.y)};
    }
    const double length = std::hypot(normal.x, normal.y, normal.z);
    normal = {normal.x / length, normal.y / length, normal.z / length};
    CHECK(distance(normal, limit->normal->unit) < 0.05);
    CHECK(distance(centre, {limit->point.x.to_double(), limit->point.y.to_double(), limit->point.z.to_double()}) < 0.01);
  }
}

TEST_CASE("the subdominant eigenvalues are those of the reference", "[midedge]") {
  MidedgeLimits limits(MidedgeRule::six_point);
  for (const auto& [k, value] : golden().at("subdominant").at("values").items()) {
    const auto size = static_cast<std::uint32_t>(std::stoul(k));
    limits.prepare(size);
    const auto [middle, radius] = limits.eigenvalue(size);
    CHECK(number(value.at("lambda_lo")) <= middle + radius);
    CHECK(middle - radius <= number(value.at("lambda_hi")));
    CHECK(radius < Rational(1).scaled(-150));
  }
}

TEST_CASE("flat data has its plane for every size, exactly for quadrilaterals", "[midedge]") {
  const auto tilt = [](const Point& p) { return Point{p.x, p.y, fraction(2, 1) * p.x - fraction(3, 1) * p.y + Rational(5)}; };
  for (const int n : {3, 4, 5, 8}) {
    // Radial fans around an n-gon: the corners of regular polygons need no exact places, only a plane.
    std::vector<Point> points;
    std::vector<std::vector<int>> facets(1);
    for (int ring = 0; ring < 5; ++ring) {
      for (int i = 0; i < 8 * n; ++i) {
        const double a = 6.283185307179586 * i / (8 * n);
        points.push_back(tilt({Rational(std::lround(1000 * (ring + 1) * std::cos(a))), Rational(std::lround(1000 * (ring + 1) * std::sin(a))), 0}));
      }
    }
    const auto at = [&](int ring, int i) { return ring * 8 * n + (i % (8 * n)); };
    for (int i = 0; i < 8 * n; ++i) facets[0].push_back(at(0, i));
    for (int ring = 0; ring < 4; ++ring) {
      for (int i = 0; i < 8 * n; ++i) facets.push_back({at(ring, i), at(ring + 1, i), at(ring + 1, i + 1), at(ring, i + 1)});
    }
    const Level level = level_of(points, facets);
    const auto limit = midedge_facet_limits(level, {}, std::array<std::uint32_t, 1>{0}).front();
    REQUIRE((limit && limit->normal));
    const double s = std::sqrt(14.0);
    CHECK(distance(limit->normal->unit, {-2 / s, 3 / s, 1 / s}) < 1e-14);
    CHECK(limit->point.z == fraction(2, 1) * limit->point.x - fraction(3, 1) * limit->point.y + Rational(5));
  }
}

TEST_CASE("the cube's facets face along the axes and its corners along the diagonals", "[midedge]") {
  const Level level = isolated(refined(golden_mesh("cube"), 1, MidedgeRule::six_point), MidedgeRule::six_point);
  const MidedgeLimits limits = prepared(MidedgeRule::six_point, level.map);
  const auto top = limits(level, 1);
  REQUIRE((top && top->normal && top->normal->exact));
  CHECK(top->normal->exact->x.is_zero());
  CHECK(top->normal->exact->y.is_zero());
  CHECK(top->normal->exact->z.sign() > 0);
  CHECK((top->point.x.is_zero() && top->point.y.is_zero()));
  const auto corner = limits(level, 13);  // vertex 7 = (1, 1, 1)
  REQUIRE((corner && corner->normal));
  CHECK((corner->point.x == corner->point.y && corner->point.y == corner->point.z));
  const double r = 1 / std::sqrt(3.0);
  CHECK(distance(corner->normal->unit, {r, r, r}) <= corner->normal->bound);
}

TEST_CASE("the 7 × 7 weights of a regular vertex come out of one step and the centre of its facet", "[midedge]") {
  const auto& expected = golden().at("limit_masks").at("regular_vertex_times_31195136_rows_y_3_to_-3");
  const int n = 11;
  const Level unit = refined(torus(n, n, [](int i, int j) { return Point{i == 5 && j == 5 ? 1 : 0, 0, 0}; }), 1, MidedgeRule::six_point);
  const MidedgeLimits limits = prepared(MidedgeRule::six_point, unit.map);
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const auto limit = limits(unit, static_cast<std::uint32_t>(n * n + j * n + i));
      REQUIRE(limit);
      const int x = 5 - i, y = 5 - j;
      const bool inside = std::abs(x) <= 3 && std::abs(y) <= 3;
      const Rational value = inside ? number(expected[static_cast<std::size_t>(3 - y)][static_cast<std::size_t>(x + 3)]) : Rational(0);
      CHECK(Rational(31195136) * limit->point.x == value);
    }
  }
}

TEST_CASE("quadratic data goes to itself and 5/16 of its Laplacian", "[midedge]") {
  // p = 2x² − xy + 3y² + x − 4 at spacing 1: Δp = 10.
  const auto p = [](const Rational& x, const Rational& y) {
    return Rational(2) * x * x - x * y + Rational(3) * y * y + x - Rational(4);
  };
  const Level level = grid(9, 9, [&](int i, int j) { return Point{i, j, p(i, j)}; });
  const MidedgeLimits limits = prepared(MidedgeRule::six_point, level.map);
  for (int j = 2; j < 7; ++j) {
    for (int i = 2; i < 7; ++i) {
      const auto limit = limits(level, static_cast<std::uint32_t>(9 * j + i));
      REQUIRE(limit);
      const Rational x = Rational(i) + fraction(1, 2), y = Rational(j) + fraction(1, 2);
      CHECK(limit->point == Point{x, y, p(x, y) + fraction(50, 16)});
      REQUIRE((limit->normal && limit->normal->exact));
      // The limit is a quadratic with the same gradient.
      const Point& m = *limit->normal->exact;
      CHECK(m.x == -m.z * (Rational(4) * x - y + Rational(1)));
      CHECK(m.y == -m.z * (Rational(6) * y - x));
      CHECK(m.z.sign() > 0);
    }
  }
}

TEST_CASE("nets end where a vertex of another valence decides on the next net", "[midedge]") {
  // n sectors of m × m quadrilaterals around a vertex of valence n.
  const int m = 6;
  for (const int n : {3, 5}) {
    std::vector<Point> points{{1, 2, 3}};
    std::vector<std::vector<int>> facets;
    std::map<std::array<int, 3>, int> numbers;
    const auto vertex = [&](int s, int i, int j) {
      if (i == 0) std::tie(s, i, j) = std::tuple((s + 1) % n, j, 0);  // on the next axis
      if (i == 0) return 0;
      const auto [at, added] = numbers.try_emplace({s, i, j}, static_cast<int>(points.size()));
      if (added) points.push_back({i * i + 5 * s * j, j * j - i * s, (7 * i + 3 * j * s) % 5});
      return at->second;
    };
    for (int s = 0; s < n; ++s) {
      for (int a = 0; a < m; ++a) {
        for (int b = 0; b < m; ++b) facets.push_back({vertex(s, a, b), vertex(s, a + 1, b), vertex(s, a + 1, b + 1), vertex(s, a, b + 1)});
      }
    }
    const Level level = level_of(points, facets), next = midedge_double_step(level, MidedgeRule::six_point);
    const MidedgeLimits limits = prepared(MidedgeRule::six_point, next.map);
    for (std::uint32_t f = 0; f < facets.size(); ++f) {
      const std::uint32_t a = f / m % m, b = f % m;
      const bool two_rings = a + 2 < m && b + 2 < m;
      CAPTURE(n, a, b);
      CHECK(midedge_net(level.map, f).empty() == !(two_rings && (a > 1 || b > 1)));
      const auto now = limits(level, f), later = limits(next, f);
      if (now) CHECK(now->point == later->point);
    }
  }
}

TEST_CASE("facets without two rings of valence 4 have no limit yet, nor normals at the boundary", "[midedge]") {
  const Level level = grid(5, 5, [](int i, int j) { return Point{i, j, i * j}; });
  MidedgeLimits limits = prepared(MidedgeRule::six_point, level.map);
  CHECK(limits(level, 12));
  CHECK_FALSE(limits(level, 6));
  CHECK_FALSE(limits(level, 0));
  // The cube has quadrilaterals all around, but vertices of valence 3.
  CHECK_FALSE(limits(golden_mesh("cube"), 0));
  // Simple rule: the mean of the corners, and no normal at the boundary.
  const MidedgeLimits simple = prepared(MidedgeRule::simple, level.map);
  CHECK(simple(level, 0)->point == Point{fraction(1, 2), fraction(1, 2), fraction(1, 4)});
  CHECK_FALSE(simple(level, 0)->normal);
  CHECK(simple(level, 6)->normal);
}
