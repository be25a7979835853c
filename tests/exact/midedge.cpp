// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/midedge.hpp"

#include "hexact/kernel/midedge_counts.hpp"
#include "midedge_samples.hpp"

#include <catch2/catch.hpp>

#include <tbb/global_control.h>

#include <set>

using namespace hexact;
using namespace hexact::midedge_samples;

namespace {

constexpr MidedgeRule kRules[] = {MidedgeRule::simple, MidedgeRule::six_point};
const char* golden_name(MidedgeRule rule) { return rule == MidedgeRule::simple ? "simple" : "new"; }

Rational fraction(long p, long q) { return Rational(Integer(p), Integer(q)); }

std::vector<Level> closed_samples() {
  std::vector<Level> all;
  for (const char* name : {"cube", "tetra", "octa", "regular_torus_6x5"}) all.push_back(golden_mesh(name));
  for (const auto& figure : golden().at("figures")) all.push_back(level_of(figure.at("input")));
  for (const int n : {5, 7, 11}) all.push_back(tower(n));
  return all;
}

/// The points equal those of the reference, and so do the loops up to the corner where they begin.
void check_same(const Level& level, const nlohmann::json& expected) {
  const Level reference = level_of(expected);
  CHECK(level.points == reference.points);
  CHECK(rotated_loops(level.map) == rotated_loops(reference.map));
  CHECK(counts(level.map) == expected.at("counts").get<std::vector<std::size_t>>());
}

/// Everything that the map stores about neighbours fits together.
void check_consistent(const MidedgeMap& map) {
  std::vector<std::uint32_t> corners(map.vertex_count(), 0);
  std::size_t open = 0;
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    REQUIRE(map.previous(map.next(h)) == h);
    REQUIRE(map.facet(map.next(h)) == map.facet(h));
    REQUIRE(h - map.facet_start(map.facet(h)) < map.facet_size(map.facet(h)));
    ++corners[map.origin(h)];
    const std::uint32_t t = map.twin(h);
    if (t == kNoTwin) {
      ++open;
      continue;
    }
    REQUIRE(map.twin(t) == h);
    REQUIRE(map.origin(t) == map.target(h));
    REQUIRE(map.target(t) == map.origin(h));
  }
  CHECK(map.edge_count() == (map.half_edge_count() + open) / 2);
  CHECK(*std::min_element(corners.begin(), corners.end()) > 0);
}

Point weighted_mean(const Level& level) {
  Point sum;
  for (std::uint32_t h = 0; h < level.map.half_edge_count(); ++h) {
    const Point& p = level.points[level.map.origin(h)];
    sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z};
  }
  const Rational n(static_cast<long>(level.map.half_edge_count()));
  return {sum.x / n, sum.y / n, sum.z / n};
}

Point mean(const Level& level) {
  Point sum;
  for (const Point& p : level.points) sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z};
  const Rational n(static_cast<long>(level.points.size()));
  return {sum.x / n, sum.y / n, sum.z / n};
}

Level mapped(Level level, const std::function<Point(const Point&)>& f) {
  for (Point& p : level.points) p = f(p);
  return level;
}

}  // namespace

TEST_CASE("Midedge steps have the points and facets of the reference", "[midedge]") {
  for (const char* name : {"cube", "tetra", "octa"}) {
    for (const MidedgeRule rule : kRules) {
      const auto& expected = golden().at("meshes").at(name).at(golden_name(rule));
      CAPTURE(name, golden_name(rule));
      check_same(refined(golden_mesh(name), 1, rule), expected[0]);
      check_same(refined(golden_mesh(name), 2, rule), expected[1]);
    }
  }
  const auto& torus_data = golden().at("meshes").at("regular_torus_6x5");
  check_same(refined(golden_mesh("regular_torus_6x5"), 1, MidedgeRule::six_point), torus_data.at("new")[0]);
  const auto& open = golden().at("meshes").at("open_grid_4x3");
  check_same(midedge_double_step(golden_mesh("open_grid_4x3"), MidedgeRule::six_point), open.at("double_step"));
  check_same(refined(golden_mesh("open_grid_4x3"), 1, MidedgeRule::six_point), open.at("single_step_close"));
}

TEST_CASE("counts, Euler characteristic, valences and facet sizes of closed meshes", "[midedge]") {
  for (const Level& base : closed_samples()) {
    const std::size_t v0 = base.map.vertex_count(), e0 = base.map.edge_count(), f0 = base.map.facet_count();
    std::map<std::size_t, std::size_t> irregular = facet_sizes(base.map);
    std::vector<std::size_t> valence(v0, 0);
    for (std::uint32_t h = 0; h < base.map.half_edge_count(); ++h) ++valence[base.map.origin(h)];
    for (const std::size_t n : valence) ++irregular[n];
    irregular.erase(4);
    MidedgeMap map = base.map;
    for (std::size_t n = 1; n <= 6; ++n) {
      map = map.stepped(MidedgeBoundary::close);
      check_consistent(map);
      CHECK(counts(map) == std::vector<std::size_t>{e0 << (n - 1), e0 << n, (e0 << (n - 1)) + v0 + f0 - e0});
      auto sizes = facet_sizes(map);
      sizes.erase(4);
      CHECK(sizes == irregular);
      const auto loops = map.loops();
      CHECK(analyse_topology(loops, map.vertex_count()).valences == std::map<std::size_t, std::size_t>{{4, map.vertex_count()}});
    }
  }
  for (const auto& figure : golden().at("figures")) {
    MidedgeMap map = level_of(figure.at("input")).map;
    for (const auto& expected : figure.at("counts_V_E_F")) {
      CHECK(counts(map) == expected.get<std::vector<std::size_t>>());
      map = map.stepped(MidedgeBoundary::close);
    }
  }
}

TEST_CASE("facets keep their addresses", "[midedge]") {
  MidedgeMap map = golden_mesh("cube").map;
  const MidedgeMap base = map;
  for (int n = 0; n < 4; ++n) map = map.stepped(MidedgeBoundary::close);
  CHECK(map.address(5) == FacetAddress{});
  CHECK(map.address(6) == FacetAddress{1, make_id<VertexId>(0)});
  CHECK(map.address(13) == FacetAddress{1, make_id<VertexId>(7)});
  CHECK(map.address(14) == FacetAddress{2, make_id<VertexId>(0)});
  CHECK(map.address(97) == FacetAddress{4, make_id<VertexId>(47)});
  // 12 inner vertices of the 4 × 3 grid, 17 inner edges.
  const MidedgeMap grid_map = golden_mesh("open_grid_4x3").map.double_stepped();
  CHECK(grid_map.address(11) == FacetAddress{});
  CHECK(grid_map.address(12).level == 2);
  CHECK(grid_map.address(28).level == 2);
  CHECK(grid_map.address(29) == FacetAddress{1, make_id<VertexId>(6)});
  CHECK(grid_map.address(34) == FacetAddress{1, make_id<VertexId>(13)});
}

TEST_CASE("the mean of the vertices is that of the valences before, exactly, and stays", "[midedge]") {
  for (const Level& base : closed_samples()) {
    for (const MidedgeRule rule : kRules) {
      Level level = base;
      const Point expected = weighted_mean(base);
      for (int n = 0; n < 3; ++n) {
        level = midedge_step(level, rule, MidedgeBoundary::close);
        CHECK(mean(level) == expected);
      }
    }
  }
}

TEST_CASE("the six-point rule is a positive filter of the simple midpoints, for all facet sizes", "[midedge]") {
  for (const Level& base : closed_samples()) {
    const auto s = edge_points<Rational>(base.map, base.points, MidedgeRule::simple);
    const auto p = edge_points<Rational>(base.map, base.points, MidedgeRule::six_point);
    const auto edge = base.map.edge_numbers();
    std::vector<Point> expected(s.size());
    const auto add = [&](std::uint32_t e, const Rational& w, const Point& q) {
      expected[e] = {expected[e].x + w * q.x, expected[e].y + w * q.y, expected[e].z + w * q.z};
    };
    for (std::uint32_t e = 0; e < s.size(); ++e) add(e, fraction(5, 8), s[e]);
    for (std::uint32_t f = 0; f < base.map.facet_count(); ++f) {
      const std::uint32_t start = base.map.facet_start(f), k = base.map.facet_size(f);
      const Rational q = fraction(3, 16 * (static_cast<long>(k) - 2));
      for (std::uint32_t i = 0; i < k; ++i) {
        add(edge[start + i], -q, s[edge[start + i]]);
        for (std::uint32_t j = 0; j < k; ++j) {
          if (j != i) add(edge[start + i], q, s[edge[start + j]]);
        }
      }
    }
    CHECK(std::equal(p.begin(), p.end(), expected.begin(), expected.end()));
  }
}

TEST_CASE("on quadrilaterals of valence 4 the filter is 1/4 and four times 3/16", "[midedge]") {
  const Level base = golden_mesh("regular_torus_6x5");
  const Level s = refined(base, 1, MidedgeRule::simple), p = refined(base, 1, MidedgeRule::six_point);
  std::vector<Point> expected;
  for (const Point& q : s.points) expected.push_back({fraction(1, 4) * q.x, fraction(1, 4) * q.y, fraction(1, 4) * q.z});
  for (std::uint32_t h = 0; h < s.map.half_edge_count(); ++h) {
    Point& e = expected[s.map.origin(h)];
    const Point& q = s.points[s.map.target(h)];
    e = {e.x + fraction(3, 16) * q.x, e.y + fraction(3, 16) * q.y, e.z + fraction(3, 16) * q.z};
  }
  CHECK(p.points == expected);
}

TEST_CASE("the sixteen weights of two regular steps", "[midedge]") {
  // The corner of vertex (3, 3) in the facet between (3, 3) and (4, 4) sees the vertices (2..5) × (2..5).
  for (const MidedgeRule rule : kRules) {
    const char* key = rule == MidedgeRule::simple ? "two_step_mask_simple_times_4" : "two_step_mask_times_1024";
    const Rational scale(rule == MidedgeRule::simple ? 4 : 1024);
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        const Level unit = torus(8, 8, [&](int i, int j) { return Point{i == 2 + a && j == 2 + b ? 1 : 0, 0, 0}; });
        const auto corners = corner_points<Rational>(unit.map, unit.points, rule);
        const std::uint32_t h = 4 * (3 * 8 + 3);  // facet 3 + 8·3, whose corner 0 is vertex (3, 3)
        CHECK(scale * corners[h].x == number(golden().at("masks").at(key)[static_cast<std::size_t>(a)][static_cast<std::size_t>(b)]));
      }
    }
  }
}

TEST_CASE("a double step equals two single steps on closed meshes", "[midedge]") {
  const auto less = [](const Point& p, const Point& q) {
    if (p.x != q.x) return p.x < q.x;
    return p.y != q.y ? p.y < q.y : p.z < q.z;
  };
  for (const Level& base : closed_samples()) {
    for (const MidedgeRule rule : kRules) {
      const Level once = midedge_double_step(base, rule), twice = refined(base, 2, rule);
      check_consistent(once.map);
      CHECK(counts(once.map) == counts(twice.map));
      auto p = once.points, q = twice.points;
      std::sort(p.begin(), p.end(), less);
      std::sort(q.begin(), q.end(), less);
      CHECK(p == q);
      using Loops = std::multiset<std::vector<std::string>>;
      const auto loops = [](const Level& level) {
        Loops all;
        for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) {
          std::vector<std::string> loop;
          for (const std::uint32_t v : level.map.loop(f)) {
            const Point& point = level.points[v];
            loop.push_back(point.x.str() + " " + point.y.str() + " " + point.z.str());
          }
          std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
          all.insert(loop);
        }
        return all;
      };
      CHECK(loops(once) == loops(twice));
    }
  }
}

TEST_CASE("a step after a double step is like any other", "[midedge]") {
  Level level = midedge_double_step(golden_mesh("cube"), MidedgeRule::six_point);
  level = refined(level, 3, MidedgeRule::six_point);
  check_consistent(level.map);
  CHECK(counts(level.map) == std::vector<std::size_t>{192, 384, 194});
  CHECK(mean(level) == Point{0, 0, 0});
}

TEST_CASE("the checkerboard vanishes in one step", "[midedge]") {
  const auto sign = [](int i, int j) { return Point{(i + j) % 2 == 0 ? 1 : -1, 0, 0}; };
  for (const MidedgeRule rule : kRules) {
    const Level level = refined(torus(8, 6, sign), 1, rule);
    for (const Point& p : level.points) CHECK(p == Point{0, 0, 0});
  }
}

TEST_CASE("affine maps commute with a step, and points lie in the box of their stencil", "[midedge]") {
  const auto affine = [](const Point& p) {
    return Point{fraction(2, 3) * p.x - p.y + Rational(7), p.x + fraction(1, 5) * p.z, p.y - Rational(3) * p.z + Rational(1)};
  };
  for (const Level& base : closed_samples()) {
    for (const MidedgeRule rule : kRules) {
      CHECK(refined(mapped(base, affine), 2, rule).points == mapped(refined(base, 2, rule), affine).points);
    }
    const auto p = edge_points<Rational>(base.map, base.points, MidedgeRule::six_point);
    const auto edge = base.map.edge_numbers();
    for (std::uint32_t h = 0; h < base.map.half_edge_count(); ++h) {
      Rational low = base.points[base.map.origin(h)].x, high = low;
      for (const std::uint32_t side : {h, base.map.twin(h)}) {
        for (const std::uint32_t v : base.map.loop(base.map.facet(side))) {
          low = std::min(low, base.points[v].x);
          high = std::max(high, base.points[v].x);
        }
      }
      CHECK((low <= p[edge[h]].x && p[edge[h]].x <= high));
    }
  }
}

TEST_CASE("boundaries: dual and close stay manifold, drop pinches as the reference says", "[midedge]") {
  const Level base = golden_mesh("open_grid_4x3");
  const auto& expected = golden().at("meshes").at("open_grid_4x3");
  Level level = base;
  for (const auto& c : expected.at("counts_double")) {
    CHECK(counts(level.map) == c.get<std::vector<std::size_t>>());
    const MeshTopology t = analyse_topology(level.map.loops(), level.map.vertex_count());
    CHECK((t.manifold && t.oriented && t.euler == 1 && t.boundary_loops == 1));
    check_consistent(level.map);
    level = midedge_double_step(level, MidedgeRule::six_point);
  }
  level = base;
  for (const auto& c : expected.at("counts_close")) {
    CHECK(counts(level.map) == c.get<std::vector<std::size_t>>());
    const MeshTopology t = analyse_topology(level.map.loops(), level.map.vertex_count());
    CHECK((t.manifold && t.oriented && t.euler == 1 && t.boundary_loops == 1));
    CHECK(level.map.pinched_vertex_count() == 0);
    check_consistent(level.map);
    level = midedge_step(level, MidedgeRule::six_point, MidedgeBoundary::close);
  }
  level = refined(base, 2, MidedgeRule::six_point, MidedgeBoundary::drop);
  CHECK(counts(level.map) == std::vector<std::size_t>{48, 72, 25});
  CHECK(level.map.pinched_vertex_count() == 4);
  for (const std::int64_t euler : {5, 11}) {
    level = midedge_step(level, MidedgeRule::six_point, MidedgeBoundary::drop);
    CHECK(analyse_topology(level.map.loops(), level.map.vertex_count()).euler == euler);
  }
}

TEST_CASE("ghost points beyond the boundary give the middle of a boundary edge", "[midedge]") {
  // Tan and Cao eq. (9), third formula corrected: P21 = 2 P22 − P23, P31 = 2 P32 − P33 in 5/16 and 3/32.
  const Level base = golden_mesh("open_grid_4x3");
  const auto p = edge_points<Rational>(base.map, base.points, MidedgeRule::six_point);
  const auto edge = base.map.edge_numbers();
  for (std::uint32_t h = 0; h < base.map.half_edge_count(); ++h) {
    if (base.map.twin(h) != kNoTwin) continue;
    const Rational a = base.points[base.map.origin(h)].z, b = base.points[base.map.target(h)].z;
    const Rational c = base.points[base.map.target(base.map.next(h))].z, d = base.points[base.map.origin(base.map.previous(h))].z;
    const Rational ghosts = (Rational(2) * a - d) + (Rational(2) * b - c);
    CHECK(p[edge[h]].z == fraction(5, 16) * (a + b) + fraction(3, 32) * (c + d) + fraction(3, 32) * ghosts);
  }
}

TEST_CASE("doubles are exact for the cube up to step 7", "[midedge]") {
  for (const MidedgeRule rule : kRules) {
    Level exact = golden_mesh("cube");
    MidedgeLevel<double> level = in_doubles(exact);
    for (int n = 1; n <= 7; ++n) {
      exact = midedge_step(exact, rule, MidedgeBoundary::close);
      level = midedge_step(level, rule, MidedgeBoundary::close);
      for (std::size_t v = 0; v < exact.points.size(); ++v) {
        REQUIRE(Rational::from_double(level.points[v].x) == exact.points[v].x);
        REQUIRE(Rational::from_double(level.points[v].y) == exact.points[v].y);
        REQUIRE(Rational::from_double(level.points[v].z) == exact.points[v].z);
      }
    }
  }
}

TEST_CASE("Midedge meshes do not depend on the number of threads", "[midedge]") {
  const auto run = [](std::size_t threads, bool open) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    MidedgeLevel<double> level = in_doubles(open ? golden_mesh("open_grid_4x3") : tower(7));
    for (int n = 0; n < 14; n += open ? 2 : 1) {
      level = open ? midedge_double_step(level, MidedgeRule::six_point)
                   : midedge_step(level, MidedgeRule::six_point, MidedgeBoundary::close);
    }
    return level;
  };
  for (const bool open : {false, true}) {
    const auto one = run(1, open), two = run(2, open);
    CHECK(one.points == two.points);
    CHECK(one.map.loops() == two.map.loops());
  }
}

TEST_CASE("meshes that Midedge cannot refine are named by element", "[midedge]") {
  const auto findings = [](std::size_t vertices, const std::vector<std::vector<int>>& facets) {
    FacetLoops loops;
    for (const auto& facet : facets) {
      for (const int v : facet) loops.add_corner(make_id<VertexId>(static_cast<std::size_t>(v)));
      loops.close_loop();
    }
    std::set<std::pair<std::string, std::string>> found;
    try {
      (void)MidedgeMap(loops, vertices);
    } catch (const InvalidInput& e) {
      for (const Finding& f : e.findings()) found.insert({f.code, f.element});
    }
    return found;
  };
  using Found = std::set<std::pair<std::string, std::string>>;
  const std::vector<std::vector<int>> tetrahedron{{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  CHECK(findings(4, tetrahedron).empty());
  CHECK(findings(3, {{0, 1, 2}}).empty());  // one triangle: boundary vertices may have 2 edges
  CHECK(findings(5, tetrahedron) == Found{{"UnusedVertex", "vertex 4"}});
  CHECK(findings(3, {{0, 1, 2}, {0, 2, 1}}) == Found{{"LowValence", "vertex 0"}, {"LowValence", "vertex 1"}, {"LowValence", "vertex 2"}});
  // Vertex 4 stands on the edge 0-1 of a tetrahedron.
  CHECK(findings(5, {{0, 4, 1, 2}, {0, 3, 1, 4}, {0, 2, 3}, {1, 3, 2}}) == Found{{"LowValence", "vertex 4"}});
  CHECK(findings(5, {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}).count({"NotManifold", "edge 0-1"}) == 1);
  CHECK(findings(5, {{0, 1, 2}, {0, 3, 4}}) == Found{{"NotManifold", "vertex 0"}});
  CHECK(findings(4, {{0, 1, 2}, {0, 1, 3}}) == Found{{"InconsistentOrientation", "edge 0-1"}});
  CHECK(findings(3, {{0, 1, 1}}).count({"RepeatedCorner", "facet 0"}) == 1);
  CHECK(findings(3, {{0, 1}}).count({"TooFewCorners", "facet 0"}) == 1);
  CHECK(findings(3, {{0, 1, 7}}).count({"WrongIndex", "facet 0"}) == 1);
  CHECK(findings(0, {}).count({"Empty", ""}) == 1);
}

TEST_CASE("several components are refined side by side", "[midedge]") {
  FacetLoops loops;
  for (const int shift : {0, 4}) {
    for (const auto& t : {std::vector<int>{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}) {
      for (const int v : t) loops.add_corner(make_id<VertexId>(static_cast<std::size_t>(v + shift)));
      loops.close_loop();
    }
  }
  MidedgeMap map(loops, 8);
  for (int n = 0; n < 4; ++n) map = map.stepped(MidedgeBoundary::close);
  CHECK(counts(map) == std::vector<std::size_t>{96, 192, 100});
}

TEST_CASE("the facet of a vertex begins where the first half-edge leaves it, or the boundary does", "[midedge]") {
  const auto flat = [](int i, int j) { return Point{i, j, 0}; };
  std::vector<MidedgeMap> maps;
  for (const Level& base : closed_samples()) maps.insert(maps.end(), {base.map, refined(base, 1, MidedgeRule::simple).map});
  maps.push_back(grid(4, 3, flat).map);
  maps.push_back(grid(4, 3, flat).map.stepped(MidedgeBoundary::close));
  for (const MidedgeMap& map : maps) {
    std::vector<std::uint32_t> begin(map.vertex_count(), kNoTwin), at_boundary = begin;
    for (auto h = static_cast<std::uint32_t>(map.half_edge_count()); h-- > 0;) {
      begin[map.origin(h)] = h;
      if (map.twin(h) == kNoTwin) at_boundary[map.origin(h)] = h;
    }
    const auto leaving = [&](std::uint32_t v) { return at_boundary[v] != kNoTwin ? at_boundary[v] : begin[v]; };
    const auto edge = map.edge_numbers();
    const MidedgeMap single = map.stepped(MidedgeBoundary::close), doubled = map.double_stepped();
    for (auto f = static_cast<std::uint32_t>(map.facet_count()); f < single.facet_count(); ++f) {
      CHECK(single.origin(single.facet_start(f)) == edge[leaving(static_cast<std::uint32_t>(*single.address(f).parent))]);
    }
    for (auto f = static_cast<std::uint32_t>(map.facet_count()); f < doubled.facet_count(); ++f) {
      const auto parent = static_cast<std::uint32_t>(*doubled.address(f).parent);
      const std::uint32_t h = doubled.origin(doubled.facet_start(f));
      if (doubled.address(f).level == map.level() + 1) {
        CHECK(h == leaving(parent));
      } else {
        const std::uint32_t side = map.previous(h);
        CHECK((edge[side] == parent && map.origin(side) < map.target(side)));
      }
    }
  }
}

TEST_CASE("sizes are known before the work", "[midedge]") {
  const auto sizes = [](const MidedgeMap& map) {
    return MidedgeCounts{static_cast<double>(map.vertex_count()), static_cast<double>(map.edge_count()),
                         static_cast<double>(map.facet_count())};
  };
  for (const Level& base : closed_samples()) {
    CHECK(midedge_counts_after(base.map, 3, MidedgeBoundary::dual) == sizes(refined(base, 3, MidedgeRule::simple).map));
  }
  const auto flat = [](int i, int j) { return Point{i, j, 0}; };
  std::vector<Level> open{grid(4, 3, flat), grid(5, 1, flat), grid(1, 1, flat), level_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})};
  // Two quadrilaterals that share a vertex with 2 boundary edges each side: an L of three.
  open.push_back(level_of({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}, {0, 2, 0}, {1, 2, 0}},
                          {{0, 1, 4, 3}, {1, 2, 5, 4}, {3, 4, 7, 6}}));
  for (const Level& base : open) {
    MidedgeMap dual = base.map, close = base.map, drop = base.map;
    for (unsigned n = 1; n <= 6; ++n) {
      const MidedgeMap before = drop;
      close = close.stepped(MidedgeBoundary::close);
      drop = drop.stepped(MidedgeBoundary::drop);
      check_consistent(close);
      check_consistent(drop);
      CHECK(midedge_counts_after(base.map, n, MidedgeBoundary::close) == sizes(close));
      const MidedgeCounts bound = midedge_counts_after(base.map, n, MidedgeBoundary::drop);
      CHECK((bound.vertices >= static_cast<double>(drop.vertex_count()) && bound.facets >= static_cast<double>(drop.facet_count())));
      // One step is known exactly, also from levels with pinched vertices; more are bounded.
      CHECK(midedge_counts_after(before, 1, MidedgeBoundary::drop) == sizes(drop));
      const MidedgeCounts ahead = midedge_counts_after(before, 3, MidedgeBoundary::drop);
      const MidedgeMap third = drop.stepped(MidedgeBoundary::drop).stepped(MidedgeBoundary::drop);
      CHECK((ahead.vertices >= sizes(third).vertices && ahead.edges >= sizes(third).edges && ahead.facets >= sizes(third).facets));
      if (n % 2 != 0) continue;
      dual = dual.double_stepped();
      CHECK(midedge_counts_after(base.map, n, MidedgeBoundary::dual) == sizes(dual));
    }
  }
}
