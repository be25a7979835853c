// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/kernel/midedge_attributes.hpp"

#include "hexact/kernel/midedge_statistics.hpp"
#include "midedge_samples.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace hexact;
using namespace hexact::midedge_samples;

namespace {

constexpr MidedgeRule kRules[] = {MidedgeRule::simple, MidedgeRule::six_point};
using Attributes = MeshAttributes<Rational>;

struct Carrying {
  Level level;
  Attributes attributes;
  void step(MidedgeRule rule, MidedgeBoundary boundary) {
    Level next = boundary == MidedgeBoundary::dual && !level.map.closed() ? midedge_double_step(level, rule)
                                                                          : midedge_step(level, rule, boundary);
    attributes = refined_attributes(level.map, next.map, attributes, rule);
    level = std::move(next);
  }
};

/// Texture coordinates that are the points themselves: no seams.
Attributes points_as_texture(const Level& level) {
  Attributes a;
  a.texture.values.assign(level.points.begin(), level.points.end());
  for (std::uint32_t h = 0; h < level.map.half_edge_count(); ++h) a.texture.of_corner.push_back(level.map.origin(h));
  return a;
}

const Point& texture_at(const Carrying& c, std::uint32_t h) { return c.attributes.texture.values[c.attributes.texture.of_corner[h]]; }

/// A grid of 6 × 3 facets; the columns from 3 on have texture coordinates of their own, 100 further.
Carrying grid_with_seam(const Level& level) {
  Carrying c{level, {}};
  for (const Point& p : level.points) c.attributes.texture.values.push_back(p);
  for (const Point& p : level.points) c.attributes.texture.values.push_back({p.x + Rational(100), p.y, p.z});
  const auto n = static_cast<std::uint32_t>(level.points.size());
  for (std::uint32_t h = 0; h < level.map.half_edge_count(); ++h) {
    c.attributes.texture.of_corner.push_back(level.map.origin(h) + (level.map.facet(h) % 6 >= 3 ? n : 0));
  }
  return c;
}

/// Every facet has the unit square as a piece of its own, `apart` times its number further along x.
Carrying squares(const Level& level, long apart) {
  Carrying c{level, {}};
  for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) {
    const Rational x(apart * static_cast<long>(f));
    for (const Point& p : {Point{0, 0, 0}, Point{1, 0, 0}, Point{1, 1, 0}, Point{0, 1, 0}}) c.attributes.texture.values.push_back({x + p.x, p.y, p.z});
  }
  c.attributes.texture.of_corner.resize(level.map.half_edge_count());
  std::iota(c.attributes.texture.of_corner.begin(), c.attributes.texture.of_corner.end(), 0u);
  c.attributes.texture = welded(c.attributes.texture);
  return c;
}

}  // namespace

TEST_CASE("texture coordinates without seams move as the points do", "[midedge]") {
  const auto bumpy = [](int i, int j) { return Point{i * i, j, (i * j * 5) % 7}; };
  const std::vector<Level> samples{golden_mesh("cube"), golden_mesh("octa"), golden_mesh("regular_torus_6x5"), tower(5), tower(7),
                                   grid(4, 3, bumpy), grid(3, 1, bumpy)};
  for (const Level& base : samples) {
    for (const MidedgeRule rule : kRules) {
      for (const MidedgeBoundary boundary : {MidedgeBoundary::dual, MidedgeBoundary::close, MidedgeBoundary::drop}) {
        Carrying c{base, points_as_texture(base)};
        for (int n = 0; n < 4; ++n) {
          c.step(rule, boundary);
          REQUIRE(c.attributes.texture.of_corner.size() == c.level.map.half_edge_count());
          CHECK(c.attributes.texture.values.size() == c.level.points.size());
          std::size_t wrong = 0;
          for (std::uint32_t h = 0; h < c.level.map.half_edge_count(); ++h) {
            wrong += texture_at(c, h) == c.level.points[c.level.map.origin(h)] ? 0 : 1;
          }
          CHECK(wrong == 0);
        }
      }
    }
  }
}

TEST_CASE("along a seam each side is refined as if it ended there", "[midedge]") {
  const auto bumpy = [](int i, int j) { return Point{i, j * j, (i * j) % 3}; };
  const Level whole = grid(6, 3, bumpy);
  // The same facets, cut along the column i = 3: points of the right part have a second copy.
  std::vector<Point> points = whole.points;
  std::vector<std::vector<int>> facets;
  const auto n = static_cast<int>(points.size());
  points.insert(points.end(), whole.points.begin(), whole.points.end());
  for (std::uint32_t f = 0; f < whole.map.facet_count(); ++f) {
    facets.emplace_back();
    for (const std::uint32_t v : whole.map.loop(f)) facets.back().push_back(static_cast<int>(v) + (f % 6 >= 3 ? n : 0));
  }
  std::vector<int> number(points.size(), -1);
  std::vector<Point> used;
  for (auto& facet : facets) {
    for (int& v : facet) {
      int& k = number[static_cast<std::size_t>(v)];
      if (k < 0) {
        k = static_cast<int>(used.size());
        used.push_back(points[static_cast<std::size_t>(v)]);
        if (v >= n) used.back().x = used.back().x + Rational(100);
      }
      v = k;
    }
  }
  const Level cut = level_of(used, facets);
  for (const MidedgeRule rule : kRules) {
    for (const MidedgeBoundary boundary : {MidedgeBoundary::dual, MidedgeBoundary::close}) {
      Carrying c = grid_with_seam(whole);
      c.step(rule, boundary);
      const Level apart = boundary == MidedgeBoundary::dual ? midedge_double_step(cut, rule) : midedge_step(cut, rule, boundary);
      for (std::uint32_t h = 0; h < whole.map.half_edge_count(); ++h) {
        CHECK(texture_at(c, h) == apart.points[apart.map.origin(h)]);
      }
      // Every new facet stays on one side.
      for (std::uint32_t f = 0; f < c.level.map.facet_count(); ++f) {
        const std::uint32_t start = c.level.map.facet_start(f);
        const bool right = texture_at(c, start).x > Rational(50);
        for (std::uint32_t h = start; h < start + c.level.map.facet_size(f); ++h) CHECK((texture_at(c, h).x > Rational(50)) == right);
      }
      for (int more = 0; more < 2; ++more) c.step(rule, boundary);
      CHECK(c.attributes.texture.of_corner.size() == c.level.map.half_edge_count());
    }
  }
}

TEST_CASE("pieces of a texture may lie on top of each other", "[midedge]") {
  constexpr long kApart = 1000;
  std::vector<std::vector<int>> sides;
  const Level cube = golden_mesh("cube");
  for (std::uint32_t f = 0; f < 5; ++f) {
    sides.emplace_back();
    for (const std::uint32_t v : cube.map.loop(f)) sides.back().push_back(static_cast<int>(v));
  }
  for (const Level& base : {cube, level_of({cube.points.begin(), cube.points.end()}, sides), grid(3, 2, wave)}) {
    for (const MidedgeRule rule : kRules) {
      for (const MidedgeBoundary boundary : {MidedgeBoundary::dual, MidedgeBoundary::close, MidedgeBoundary::drop}) {
        Carrying same = squares(base, 0), apart = squares(base, kApart);
        REQUIRE(same.attributes.texture.of_corner.size() == 4 * base.map.facet_count());
        for (int n = 0; n < 2; ++n) {
          same.step(rule, boundary);
          apart.step(rule, boundary);
          // Each facet lies in one piece, and its place there does not depend on where the piece is.
          std::size_t wrong = 0;
          for (std::uint32_t f = 0; f < same.level.map.facet_count(); ++f) {
            const std::uint32_t start = same.level.map.facet_start(f), size = same.level.map.facet_size(f);
            const Rational shift = texture_at(apart, start).x - texture_at(same, start).x;
            for (std::uint32_t h = start; h < start + size; ++h) {
              const Point p = texture_at(same, h);
              wrong += texture_at(apart, h) == Point{p.x + shift, p.y, p.z} ? 0 : 1;
            }
          }
          CHECK(wrong == 0);
        }
      }
    }
  }
  // The facet at vertex 0 lies in the corner of the first square; its far corner is the vertex itself.
  Carrying c = squares(cube, 0);
  c.step(MidedgeRule::simple, MidedgeBoundary::close);
  std::vector<std::pair<double, double>> at_vertex;
  for (std::uint32_t h = c.level.map.facet_start(6); h < c.level.map.facet_start(7); ++h) {
    at_vertex.emplace_back(texture_at(c, h).x.to_double(), texture_at(c, h).y.to_double());
  }
  std::sort(at_vertex.begin(), at_vertex.end());
  CHECK(at_vertex == std::vector<std::pair<double, double>>{{0, 0}, {0, 0.5}, {0.5, 0}});
}

TEST_CASE("facets without texture coordinates pass none on", "[midedge]") {
  Carrying c{golden_mesh("cube"), points_as_texture(golden_mesh("cube"))};
  for (std::uint32_t h = 0; h < 4; ++h) c.attributes.texture.of_corner[h] = kNothing;  // facet 0: vertices 0, 2, 3, 1
  c.step(MidedgeRule::six_point, MidedgeBoundary::close);
  const auto has = [&](std::uint32_t f) { return c.attributes.texture.of_corner[c.level.map.facet_start(f)] != kNothing; };
  for (std::uint32_t f = 0; f < 14; ++f) CHECK(has(f) == (f != 0 && (f < 6 || f >= 10)));
}

TEST_CASE("names go to the facets that follow the facet with the smallest number", "[midedge]") {
  Carrying c{golden_mesh("cube"), {}};
  c.attributes.groups = {{"bottom", "rest"}, {0, 1, 1, 1, kNothing, 1}};
  c.attributes.materials = {{"brick"}, {kNothing, 0, 0, 0, 0, 0}};
  c.attributes.material_libraries = {"a.mtl"};
  c.step(MidedgeRule::six_point, MidedgeBoundary::close);
  // Vertices 0 … 3 are at facet 0, vertices 4 … 7 at facet 1.
  CHECK(c.attributes.groups.of_facet == std::vector<std::uint32_t>{0, 1, 1, 1, kNothing, 1, 0, 0, 0, 0, 1, 1, 1, 1});
  c.step(MidedgeRule::six_point, MidedgeBoundary::close);
  CHECK(c.attributes.groups.names == std::vector<std::string>{"bottom", "rest"});
  CHECK(c.attributes.groups.of_facet.size() == 26);
  CHECK(c.attributes.materials.of_facet[0] == kNothing);
  CHECK(c.attributes.material_libraries == std::vector<std::string>{"a.mtl"});
  // A double step names the facets of edges as two single steps do.
  Carrying d{golden_mesh("cube"), {}};
  d.attributes.groups = {{"bottom", "rest"}, {0, 1, 1, 1, kNothing, 1}};
  const MidedgeMap after = d.level.map.double_stepped();
  const auto names = refined_attributes(d.level.map, after, d.attributes, MidedgeRule::simple).groups.of_facet;
  CHECK(std::count(names.begin(), names.end(), 0u) == std::count(c.attributes.groups.of_facet.begin(), c.attributes.groups.of_facet.end(), 0u));
}

TEST_CASE("equal texture coordinates are one", "[midedge]") {
  const CornerValues<Rational> corners{{{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, {0, 1, 2, 3, 4, kNothing}};
  CHECK(welded(corners).of_corner == std::vector<std::uint32_t>{0, 1, 0, 1, 4, kNothing});
}

TEST_CASE("keeping the size: every component keeps its volume and its centre", "[midedge]") {
  const Level cube = golden_mesh("cube");
  std::vector<Point> points = cube.points;
  std::vector<std::vector<int>> facets;
  for (const int part : {0, 1}) {
    for (std::uint32_t f = 0; f < 6; ++f) {
      facets.emplace_back();
      for (const std::uint32_t v : cube.map.loop(f)) facets.back().push_back(static_cast<int>(v) + 8 * part);
    }
  }
  for (const Point& p : cube.points) points.push_back({Rational(3) * p.x + Rational(1000), Rational(2) * p.y, p.z});
  for (const MidedgeRule rule : kRules) {
    Level level = level_of(points, facets);
    SizeKeeper<Rational> keeper(level);
    for (int n = 0; n < 5; ++n) {
      Level next = midedge_step(level, rule, MidedgeBoundary::close);
      keeper.step(level.map, next.map);
      level = std::move(next);
      keeper.fit(level);
      const Level scaled{level.map, keeper.scaled(level)};
      REQUIRE(keeper.factors().size() == 2);
      double volume[2] = {0, 0};
      Point mean[2];
      for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) {
        const auto loop = level.map.loop(f);
        const std::uint32_t part = keeper.component(f);
        CHECK(part == (level.points[loop[0]].x > Rational(500) ? 1 : 0));
        Point centre, area;
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const Point &p = scaled.points[loop[i]], &q = scaled.points[loop[(i + 1) % loop.size()]];
          centre = {centre.x + p.x, centre.y + p.y, centre.z + p.z};
          area = {area.x + p.y * q.z - p.z * q.y, area.y + p.z * q.x - p.x * q.z, area.z + p.x * q.y - p.y * q.x};
          mean[part] = {mean[part].x + p.x, mean[part].y + p.y, mean[part].z + p.z};
        }
        const Rational six = centre.x * area.x + centre.y * area.y + centre.z * area.z;
        volume[part] += (six / Rational(6 * static_cast<long>(loop.size()))).to_double();
      }
      CHECK(volume[0] == Approx(8).epsilon(1e-12));
      CHECK(volume[1] == Approx(48).epsilon(1e-12));
      CHECK(mean[0] == Point{0, 0, 0});
      CHECK(mean[1] == Point{Rational(1000L * static_cast<long>(level.map.half_edge_count() / 2)), 0, 0});
    }
    CHECK(keeper.factors()[0] == Approx(keeper.factors()[1]).epsilon(1e-12));
  }
}

TEST_CASE("keeping the size: open components keep their area and the mean of their points, closed ones their volume", "[midedge]") {
  const auto area = [](const Level& level, const SizeKeeper<Rational>& keeper, std::uint32_t component) {
    double sum = 0;
    for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) {
      if (keeper.component(f) != component) continue;
      const auto loop = level.map.loop(f);
      const auto at = [&](std::size_t i) { return level.points[loop[i % loop.size()]]; };
      Point mean;
      const Rational share = Rational(1) / Rational(static_cast<long>(loop.size()));
      for (std::size_t i = 0; i < loop.size(); ++i) mean = {mean.x + share * at(i).x, mean.y + share * at(i).y, mean.z + share * at(i).z};
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const auto from_mean = [&](const Point& p) { return Point{p.x - mean.x, p.y - mean.y, p.z - mean.z}; };
        const Point p = from_mean(at(i)), q = from_mean(at(i + 1));
        const Point n{p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
        sum += std::sqrt((n.x * n.x + n.y * n.y + n.z * n.z).to_double()) / 2;
      }
    }
    return sum;
  };
  for (const MidedgeRule rule : kRules) {
    for (const MidedgeBoundary policy : {MidedgeBoundary::dual, MidedgeBoundary::close, MidedgeBoundary::drop}) {
      Level level = beside(golden_mesh("cube"), grid(4, 3, wave));
      SizeKeeper<Rational> keeper(level);
      REQUIRE(keeper.measures().size() == 2);
      CHECK((keeper.measures()[0] == SizeMeasure::volume && keeper.measures()[1] == SizeMeasure::area));
      const double before = area(level, keeper, 1);
      CHECK(area(level, keeper, 0) == Approx(24));
      for (int n = 0; n < 2; ++n) {
        Level next = policy == MidedgeBoundary::dual ? midedge_double_step(level, rule) : midedge_step(level, rule, policy);
        keeper.step(level.map, next.map);
        level = std::move(next);
        keeper.fit(level);
        const Level scaled{level.map, keeper.scaled(level)};
        CHECK(area(scaled, keeper, 1) == Approx(before).epsilon(1e-12));
        CHECK(keeper.factors()[1] > 1);
        // About the mean of its points, each once, which so stays; by one factor.
        Point mean, scaled_mean;
        std::vector<char> seen(level.points.size(), 0);
        for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) {
          for (const std::uint32_t v : level.map.loop(f)) {
            if (keeper.component(f) != 1 || seen[v] != 0) continue;
            seen[v] = 1;
            const auto add = [](Point& sum, const Point& p) { sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z}; };
            add(mean, level.points[v]);
            add(scaled_mean, scaled.points[v]);
          }
        }
        CHECK(mean == scaled_mean);
        const Rational factor = Rational::from_double(keeper.factors()[1]);
        const auto loop = level.map.loop(static_cast<std::uint32_t>(6));
        CHECK(scaled.points[loop[1]].x - scaled.points[loop[0]].x == factor * (level.points[loop[1]].x - level.points[loop[0]].x));
      }
      // The cube's factor is that of the cube alone.
      Level cube = golden_mesh("cube");
      SizeKeeper<Rational> alone(cube);
      Level next = refined(cube, level.map.level(), rule);
      alone.step(cube.map, refined(cube, 1, rule).map);
      if (policy != MidedgeBoundary::dual) {
        alone.step(refined(cube, 1, rule).map, next.map);
        alone.fit(next);
        CHECK(keeper.factors()[0] == Approx(alone.factors()[0]).epsilon(1e-13));
      }
    }
  }
}

namespace {

template <class S>
S power_of_two_times(const Rational& x, int exponent);
template <>
Rational power_of_two_times<Rational>(const Rational& x, int exponent) { return x.scaled(exponent); }
template <>
double power_of_two_times<double>(const Rational& x, int exponent) { return std::ldexp(x.to_double(), exponent); }

/// The factors after some steps of the mesh, 2^exponent times as large.
template <class S>
std::vector<double> factors_of(const Level& base, int exponent, unsigned steps, MidedgeRule rule) {
  MidedgeLevel<S> level{base.map, {}};
  for (const Point& p : base.points) {
    level.points.push_back({power_of_two_times<S>(p.x, exponent), power_of_two_times<S>(p.y, exponent), power_of_two_times<S>(p.z, exponent)});
  }
  SizeKeeper<S> keeper(level);
  for (unsigned n = 0; n < steps; ++n) {
    MidedgeLevel<S> next = midedge_step(level, rule, MidedgeBoundary::close);
    keeper.step(level.map, next.map);
    level = std::move(next);
  }
  keeper.fit(level);
  return {keeper.factors().begin(), keeper.factors().end()};
}

}  // namespace

TEST_CASE("keeping the size: factors do not depend on the unit of length", "[midedge]") {
  const Level level = beside(golden_mesh("cube"), grid(4, 3, wave));
  for (const MidedgeRule rule : kRules) {
    const std::vector<double> expected = factors_of<Rational>(level, 0, 3, rule);
    const auto check = [&](const std::vector<double>& factors) {
      REQUIRE(factors.size() == expected.size());
      for (std::size_t c = 0; c < factors.size(); ++c) CHECK(factors[c] == Approx(expected[c]).epsilon(1e-12));
    };
    for (const int exponent : {-1000, -560, -340, 0, 343, 520, 1000}) check(factors_of<double>(level, exponent, 3, rule));
    for (const int exponent : {-4000, 4000}) check(factors_of<Rational>(level, exponent, 3, rule));
  }
  // A square has half its area after each step, for ever.
  const auto flat = [](int i, int j) { return Point{2 * i - 1, 2 * j - 1, 0}; };
  CHECK(factors_of<double>(grid(1, 1, flat), 0, 1000, MidedgeRule::simple) == std::vector<double>{std::ldexp(1.0, 500)});
  const auto beside_origin = [](int i, int j) { return Point{i, j, 0}; };
  CHECK(factors_of<Rational>(grid(1, 1, beside_origin), 0, 1000, MidedgeRule::simple) == std::vector<double>{std::ldexp(1.0, 500)});
  CHECK_THROWS_AS(factors_of<Rational>(grid(1, 1, flat), 0, 2100, MidedgeRule::simple), NumericalFailure);
}

TEST_CASE("keeping the size: sums beyond the largest double do not matter for the centre", "[midedge]") {
  // 400 corners near 2^1018 add up to more than any double.
  const Level base = grid(10, 10, [](int i, int j) { return Point{1000 + i, 1000 + j, 0}; });
  const std::vector<double> expected = factors_of<double>(base, 0, 2, MidedgeRule::simple);
  const std::vector<double> large = factors_of<double>(base, 1008, 2, MidedgeRule::simple);
  CHECK(large.front() == Approx(expected.front()).epsilon(1e-12));
}

TEST_CASE("meshes without a size to keep are refused", "[midedge]") {
  const auto code = [](const Level& level) {
    try {
      SizeKeeper<Rational> keeper(level);
    } catch (const InvalidInput& e) {
      return e.code() + " " + e.findings().front().element;
    }
    return std::string();
  };
  CHECK(code(golden_mesh("cube")).empty());
  CHECK(code(golden_mesh("open_grid_4x3")).empty());
  const auto flat = [](int i, int j) { return Point{i + j, 2 * (i + j), 5}; };
  CHECK(code(grid(3, 2, flat)) == "NoArea facet 0");
  CHECK(code(beside(golden_mesh("cube"), grid(3, 2, flat))) == "NoArea facet 6");
  CHECK(code(level_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}})) == "NoVolume facet 0");
}
