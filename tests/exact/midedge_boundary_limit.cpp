// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/midedge_boundary_limit.hpp"

#include "hexact/kernel/midedge_part.hpp"
#include "midedge_samples.hpp"

#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <set>

using namespace hexact;
using namespace hexact::midedge_samples;

namespace {

using Corner = MidedgeCorner;
using Pattern = MidedgeBoundaryPattern;
using Matrix = std::vector<std::vector<double>>;

/// Facets of a mesh that touch the boundary and do not stand alone.
std::vector<std::uint32_t> at_boundary(const MidedgeMap& map) {
  std::vector<std::uint32_t> facets;
  for (std::uint32_t f = 0; f < map.facet_count(); ++f) {
    const Pattern pattern = midedge_boundary_pattern(map, f);
    if (touches_boundary(pattern) && !stands_alone(pattern)) facets.push_back(f);
  }
  return facets;
}

std::set<Pattern> sample_patterns() {
  std::set<Pattern> patterns;
  for (const auto& [name, level] : open_samples()) {
    const Level isolated = midedge_double_step(midedge_double_step(midedge_double_step(level, MidedgeRule::simple), MidedgeRule::simple), MidedgeRule::simple);
    for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) {
      if (const auto net = midedge_boundary_net(isolated.map, f)) patterns.insert(net->pattern);
    }
  }
  // Where it stands alone the operator exists too, but nothing has to be solved.
  std::erase_if(patterns, [](const Pattern& p) { return !touches_boundary(p) || stands_alone(p); });
  return patterns;
}

/// The limit of facet 0 for values on the grid: the corner of a grid, or the middle of its left side.
Rational grid_limit(bool corner, const std::function<Rational(Rational, Rational)>& value) {
  const int shift = corner ? 0 : 3;
  const Level level = grid(5, 8, [&](int i, int j) { return Point{value(Rational(i), Rational(j - shift)), i, j}; });
  const auto f = static_cast<std::uint32_t>(5 * shift);
  MidedgeBoundaryLimits limits;
  limits.prepare(midedge_boundary_pattern(level.map, f));
  const auto limit = limits(level, f);
  REQUIRE(limit);
  return limit->x;
}

Rational fraction(long p, long q) { return Rational(Integer(p), Integer(q)); }

Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c(a.size(), std::vector<double>(a.size(), 0));
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t k = 0; k < a.size(); ++k) {
      for (std::size_t j = 0; j < a.size(); ++j) c[i][j] += a[i][k] * b[k][j];
    }
  }
  return c;
}

/// Dobrushin's coefficient: the range of values after the matrix is at most this part of the range before.
double contraction(const Matrix& m) {
  double worst = 0;
  for (const auto& a : m) {
    for (const auto& b : m) {
      double sum = 0;
      for (std::size_t c = 0; c < m.size(); ++c) sum += std::fabs(a[c] - b[c]);
      worst = std::max(worst, sum / 2);
    }
  }
  return worst;
}

}  // namespace

TEST_CASE("patterns tell inner corners, gaps and rims, and double steps keep them", "[midedge]") {
  const Level level = grid(3, 3, wave);
  CHECK(midedge_boundary_pattern(level.map, 0) == Pattern{Corner::rim, Corner::gap, Corner::inner, Corner::rim});
  CHECK(midedge_boundary_pattern(level.map, 1) == Pattern{Corner::rim, Corner::gap, Corner::inner, Corner::inner});
  CHECK_FALSE(touches_boundary(midedge_boundary_pattern(level.map, 4)));
  for (const auto& [name, sample] : open_samples()) {
    const Level next = midedge_double_step(sample, MidedgeRule::six_point);
    for (std::uint32_t f = 0; f < sample.map.facet_count(); ++f) {
      CHECK(midedge_boundary_pattern(sample.map, f) == midedge_boundary_pattern(next.map, f));
      CHECK(stands_alone(midedge_boundary_pattern(next.map, f)) == (name == "alone"));
    }
  }
}

TEST_CASE("the operator of a pattern is what double steps do to the net of every facet that has it", "[midedge]") {
  for (const auto& [name, sample] : open_samples()) {
    Level level = midedge_double_step(midedge_double_step(midedge_double_step(sample, MidedgeRule::six_point), MidedgeRule::six_point), MidedgeRule::six_point);
    const Level next = midedge_double_step(level, MidedgeRule::six_point);
    std::map<Pattern, std::vector<std::vector<Rational>>> operators;
    std::size_t tested = 0;
    for (const std::uint32_t f : at_boundary(level.map)) {
      const auto from = midedge_boundary_net(level.map, f), to = midedge_boundary_net(next.map, f);
      if (!from) continue;
      ++tested;
      REQUIRE(to);
      REQUIRE(from->pattern == to->pattern);
      if (operators.count(from->pattern) == 0) operators[from->pattern] = midedge_boundary_operator(from->pattern);
      const auto& m = operators.at(from->pattern);
      REQUIRE(m.size() == from->vertices.size());
      for (std::size_t r = 0; r < m.size(); ++r) {
        Point p;
        for (std::size_t c = 0; c < m.size(); ++c) {
          const Point& q = level.points[from->vertices[c]];
          p = {p.x + m[r][c] * q.x, p.y + m[r][c] * q.y, p.z + m[r][c] * q.z};
        }
        REQUIRE(p == next.points[to->vertices[r]]);
      }
    }
    // After three double steps every facet of the input at the boundary has its net.
    CAPTURE(name, tested);
    for (const std::uint32_t f : at_boundary(sample.map)) CHECK(midedge_boundary_net(level.map, f));
    CHECK((tested > 8 || name == "alone"));
  }
}

TEST_CASE("weights at the boundary are a left eigenvector for 1, non-negative, of sum 1", "[midedge]") {
  const std::set<Pattern> patterns = sample_patterns();
  CHECK(patterns.size() >= 8);
  for (const Pattern& pattern : patterns) {
    const auto m = midedge_boundary_operator(pattern);
    const std::vector<Rational> w = midedge_boundary_weights(pattern);
    Rational sum;
    for (std::size_t c = 0; c < w.size(); ++c) {
      Rational image, row;
      for (std::size_t r = 0; r < w.size(); ++r) {
        image += w[r] * m[r][c];
        row += m[c][r];
        CHECK(m[r][c].sign() >= 0);
      }
      CHECK(row == Rational(1));
      CHECK(image == w[c]);
      CHECK(w[c].sign() >= 0);
      sum += w[c];
    }
    CHECK(sum == Rational(1));
    CHECK(w[0].sign() > 0);
  }
}

TEST_CASE("limits at the side and at the corner of a grid are those of an independent computation", "[midedge]") {
  // Fractions from a program of its own on index formulas of the half and the quarter plane. The side runs along y.
  using R = Rational;
  const auto x = [](R i, R) { return i; };
  CHECK(grid_limit(true, x) == fraction(1, 2));
  CHECK(grid_limit(false, x) == fraction(1, 2));
  CHECK(grid_limit(true, [](R i, R) { return i * i; }) == fraction(698472326987, 1116396780908));
  CHECK(grid_limit(true, [](R, R j) { return j * j; }) == fraction(698472326987, 1116396780908));
  CHECK(grid_limit(true, [](R i, R j) { return i * j; }) == fraction(72440717248, 279099195227));
  CHECK(grid_limit(true, [](R i, R j) { return i * i * j; }) == fraction(94260918478, 279099195227));
  CHECK(grid_limit(true, [](R i, R) { return i * i * i; }) == fraction(245838403285, 279099195227));
  CHECK(grid_limit(false, [](R i, R) { return i * i; }) == fraction(89353, 138722));
  CHECK(grid_limit(false, [](R, R j) { return j * j; }) == fraction(445943, 554888));
  CHECK(grid_limit(false, [](R i, R j) { return i * j; }) == fraction(1, 4));
  CHECK(grid_limit(false, [](R i, R) { return i * i * i; }) == fraction(130471, 138722));
  // The weight of single vertices.
  const auto only = [](int a, int b) { return [=](R i, R j) { return i == R(a) && j == R(b) ? R(1) : R(0); }; };
  CHECK(grid_limit(true, only(0, 0)) == fraction(87013899554, 279099195227));
  CHECK(grid_limit(true, only(3, 2)) == fraction(14479155, 279099195227));
  CHECK(grid_limit(true, only(3, 3)).is_zero());
}

TEST_CASE("twelve double steps in floating point come as near to the limit as the contraction of the operator says", "[midedge]") {
  constexpr int kSteps = 12;
  for (const auto& [name, sample] : open_samples()) {
    const Level base = midedge_double_step(midedge_double_step(midedge_double_step(sample, MidedgeRule::six_point), MidedgeRule::six_point), MidedgeRule::six_point);
    MidedgeBoundaryLimits limits;
    for (const std::uint32_t f : at_boundary(sample.map)) {
      limits.prepare(midedge_boundary_pattern(base.map, f));
      const auto limit = limits(base, f);
      REQUIRE(limit);
      // All later points of the net, and the limit, lie in the range of the net, which falls by `factor` every 4 steps.
      const auto net = midedge_boundary_net(base.map, f);
      Matrix m;
      for (const auto& row : midedge_boundary_operator(net->pattern)) {
        m.emplace_back();
        for (const Rational& x : row) m.back().push_back(x.to_double());
      }
      m = product(m, m);
      const double factor = contraction(product(m, m));
      CHECK(factor < 0.9);
      double low = 1e300, high = -1e300;
      for (const std::uint32_t v : net->vertices) {
        low = std::min(low, base.points[v].z.to_double());
        high = std::max(high, base.points[v].z.to_double());
      }
      MidedgeLevel<double> level = in_doubles(base);
      std::uint32_t facet = f;
      for (int n = 0; n < kSteps; ++n) {
        MidedgePart part = midedge_part(level.map, std::array{facet}, 2);
        MidedgeLevel<double> cut{std::move(part.map), {}};
        for (const std::uint32_t v : part.vertices) cut.points.push_back(level.points[v]);
        level = midedge_double_step(cut, MidedgeRule::six_point);
        facet = 0;
      }
      CAPTURE(name, f, factor);
      for (const std::uint32_t v : level.map.loop(0)) {
        CHECK(std::fabs(level.points[v].z - limit->z.to_double()) <= std::pow(factor, kSteps / 4) * (high - low) + 1e-12);
      }
    }
  }
}

TEST_CASE("facets whose limit depends on too many vertices have none", "[midedge]") {
  // A polygon of n corners with quadrilaterals on all sides but one: 8 (n − 2) + 6 vertices.
  const auto limit = [](int n) {
    std::vector<Point> points;
    std::vector<std::vector<int>> facets(1);
    for (int i = 0; i < n; ++i) points.push_back({i, i * i, 0});
    for (int i = 0; i < n; ++i) points.push_back({i + 10, i, 1});
    for (int i = 0; i < n; ++i) facets[0].push_back(i);
    for (int i = 0; i + 1 < n; ++i) facets.push_back({i + 1, i, n + i, n + i + 1});
    Level level = level_of(points, facets);
    for (int step = 0; step < 3; ++step) level = midedge_double_step(level, MidedgeRule::simple);
    MidedgeBoundaryLimits limits;
    limits.prepare(midedge_boundary_pattern(level.map, 0));
    const auto net = midedge_boundary_net(level.map, 0);
    REQUIRE(net);
    REQUIRE(net->vertices.size() == 8u * static_cast<unsigned>(n - 2) + 6);
    return limits(level, 0);
  };
  CHECK(limit(7));
  CHECK(limit(25));
  CHECK_FALSE(limit(140));
}
