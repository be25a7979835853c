// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/honeycomb.hpp"

#include "exact/honeycomb_golden.hpp"
#include "hexact/exact/volume.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

namespace hexact {
namespace {

using test::number;

using test::constant;
using test::golden_policy;
using test::needs_root;

template <class S>
void check_number(const S& x, const nlohmann::json& expected) {
  if (expected.is_string()) {
    CHECK(x.str() == expected.get<std::string>());
    return;
  }
  CHECK(test::residue(x) == expected.at("mod_p61").get<std::uint64_t>());
  CHECK(x.to_double() == Approx(expected.at("double").get<double>()).epsilon(1e-15));
  if (!expected.at("exact").is_null()) CHECK(x.str() == number(expected.at("exact").get<std::string>()).str());
}

template <class S>
void check_level(const HoneycombLevel<S>& level, const nlohmann::json& expected) {
  CHECK(level.map.vertex_count() == expected.at("V"));
  CHECK(level.map.edge_count() == expected.at("E"));
  CHECK(level.map.facet_count() == expected.at("F"));
  std::map<std::string, std::size_t> sizes;
  for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) ++sizes[std::to_string(level.map.facet_size(f))];
  CHECK(sizes == expected.at("face_sizes").get<std::map<std::string, std::size_t>>());
  CHECK(test::fingerprint(level.points) == expected.at("fingerprint").get<std::uint64_t>());
  if (expected.contains("volume")) {
    check_number(exact_volume(std::span<const Point3<S>>(level.points), level.map.loops()), expected.at("volume"));
  }
}

/// Area and the extreme products of unit normals across an edge, in double from exact points and planes.
template <class S>
void check_measures(const HoneycombLevel<S>& level, const nlohmann::json& expected) {
  const HoneycombMap& map = level.map;
  double area = 0, least = 1, most = -1;
  std::vector<std::array<double, 3>> normals;
  for (std::uint32_t f = 0; f < map.facet_count(); ++f) {
    const Plane<S>& plane = level.planes[f];
    S largest(0);
    for (const S& x : {plane.a, plane.b, plane.c}) {
      if (largest < (x.sign() < 0 ? -x : x)) largest = x.sign() < 0 ? -x : x;
    }
    const double a = S(plane.a / largest).to_double(), b = S(plane.b / largest).to_double(), c = S(plane.c / largest).to_double();
    const double length = std::sqrt(a * a + b * b + c * c);
    normals.push_back({a / length, b / length, c / length});
    const std::uint32_t start = map.facet_start(f);
    const auto at = [&](std::uint32_t h) {
      const auto &p = level.points[map.origin(h)], &o = level.points[map.origin(start)];
      return std::array<double, 3>{S(p.x - o.x).to_double(), S(p.y - o.y).to_double(), S(p.z - o.z).to_double()};
    };
    for (std::uint32_t h = start + 1; h + 1 < start + map.facet_size(f); ++h) {
      const auto p = at(h), q = at(h + 1);
      const auto& n = normals.back();
      area += (n[0] * (p[1] * q[2] - p[2] * q[1]) + n[1] * (p[2] * q[0] - p[0] * q[2]) + n[2] * (p[0] * q[1] - p[1] * q[0])) / 2;
    }
  }
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    const auto &m = normals[map.facet(h)], &n = normals[map.facet(map.twin(h))];
    const double product = m[0] * n[0] + m[1] * n[1] + m[2] * n[2];
    least = std::min(least, product);
    most = std::max(most, product);
  }
  CHECK(area == Approx(expected.at("area").get<double>()).epsilon(1e-12));
  CHECK(least == Approx(expected.at("normal_dot_min").get<double>()).margin(1e-12));
  CHECK(most == Approx(expected.at("normal_dot_max").get<double>()).margin(1e-12));
  CHECK(expected.at("dihedral_cos_min").get<double>() == Approx(-most).margin(1e-12));
  CHECK(expected.at("dihedral_cos_max").get<double>() == Approx(-least).margin(1e-12));
}

template <class S>
void check_case(const nlohmann::json& closed, const PlaneBody& body) {
  const CutPolicy policy = golden_policy(closed.at("parameters"));
  HoneycombLevel<S> level = honeycomb_start<S>(body);
  for (const auto& expected : closed.at("levels")) {
    INFO("level " << expected.at("level"));
    while (level.map.level() < expected.at("level").get<std::uint32_t>()) {
      HoneycombStep<S> step = honeycomb_step(level, policy);
      level = std::move(step.level);
      if (level.map.level() == expected.at("level") && expected.contains("delta")) {
        check_number(step.figures.delta, expected.at("delta"));
        check_number(step.figures.min_gap, expected.at("min_gap"));
      }
    }
    check_level(level, expected);
    check_measures(level, expected);
  }
}

TEST_CASE("closed golden cases agree in Q and in Q(sqrt5)", "[honeycomb][golden]") {
  const nlohmann::json data = test::golden();
  std::size_t rational_cases = 0;
  for (const auto& closed : data.at("closed")) {
    if (!closed.contains("levels")) continue;
    const std::string name = closed.at("name");
    INFO(name << ", " << closed.at("parameters"));
    const PlaneBody body = test::body_of(closed.contains("initial") ? test::solid(closed.at("initial")) : test::cube());
    check_case<QuadraticField>(closed, body);
    if (needs_root(closed, body)) continue;
    ++rational_cases;
    check_case<Rational>(closed, body);
  }
  CHECK(rational_cases >= 7);
}

TEST_CASE("points of golden levels given in full", "[honeycomb][golden]") {
  const nlohmann::json data = test::golden();
  std::size_t seen = 0;
  for (const auto& closed : data.at("closed")) {
    if (!closed.contains("level1_vertices")) continue;
    ++seen;
    const auto step = honeycomb_step(honeycomb_start<Rational>(test::body_of(test::cube())), golden_policy(closed.at("parameters")));
    const auto& expected = closed.at("level1_vertices");
    REQUIRE(expected.size() == step.level.points.size());
    for (std::size_t v = 0; v < expected.size(); ++v) {
      CHECK(step.level.points[v].x.str() == expected[v][0].get<std::string>());
      CHECK(step.level.points[v].y.str() == expected[v][1].get<std::string>());
      CHECK(step.level.points[v].z.str() == expected[v][2].get<std::string>());
    }
  }
  CHECK(seen == 1);
}

TEST_CASE("the level-1 tetrahedron, vertex by vertex and facet by facet", "[honeycomb][golden]") {
  const nlohmann::json data = test::golden();
  std::size_t seen = 0;
  for (const auto& closed : data.at("closed")) {
    if (!closed.contains("complete_level1")) continue;
    ++seen;
    const auto level = honeycomb_step(honeycomb_start<Rational>(test::body_of(test::tetrahedron())), golden_policy(closed.at("parameters"))).level;
    const test::Solid expected = test::solid(closed.at("complete_level1"));
    REQUIRE(level.points.size() == expected.points.size());
    for (std::size_t v = 0; v < expected.points.size(); ++v) {
      CHECK(Point3<QuadraticField>{level.points[v].x, level.points[v].y, level.points[v].z} == expected.points[v]);
    }
    const FacetLoops loops = level.map.loops();
    REQUIRE(loops.size() == expected.loops.size());
    for (std::size_t f = 0; f < loops.size(); ++f) {
      CHECK(std::equal(loops[f].begin(), loops[f].end(), expected.loops[f].begin(), expected.loops[f].end()));
    }
  }
  CHECK(seen == 1);
}

TEST_CASE("the level-2 cube has volume 33877/9680", "[honeycomb]") {
  auto level = honeycomb_start<Rational>(test::body_of(test::cube()));
  for (int l = 0; l < 2; ++l) level = honeycomb_step(level, static_policy_rational()).level;
  CHECK(exact_volume(to_plane_body(level)).str() == "33877/9680");
}

template <class S>
std::set<std::string> squared_edges(const HoneycombLevel<S>& level) {
  std::set<std::string> out;
  for (std::uint32_t h = 0; h < level.map.half_edge_count(); ++h) {
    const auto &p = level.points[level.map.origin(h)], &q = level.points[level.map.target(h)];
    const S x = p.x - q.x, y = p.y - q.y, z = p.z - q.z;
    out.insert(S(x * x + y * y + z * z).str());
  }
  return out;
}

TEST_CASE("static steps of regular solids are Archimedean: all edges exactly equal", "[honeycomb]") {
  const nlohmann::json data = test::golden();
  const std::map<std::string, std::string> volumes = {
      {"tetrahedron", "184/375"}, {"cube", "4"}, {"dodecahedron", "40330/6859+17038/6859*sqrt5"}};
  std::size_t seen = 0;
  for (const auto& closed : data.at("closed")) {
    if (!closed.contains("initial") || closed.at("parameters") != "static") continue;
    const auto found = volumes.find(closed.at("name"));
    if (found == volumes.end()) continue;
    const auto start = honeycomb_start<QuadraticField>(test::body_of(test::solid(closed.at("initial"))));
    const auto step = honeycomb_step(start, static_policy_sqrt5());
    CHECK(squared_edges(step.level).size() == 1);
    CHECK(exact_volume(to_plane_body(step.level)).str() == found->second);
    ++seen;
  }
  CHECK(seen == 3);
}

TEST_CASE("a step commutes with affine maps exactly, and volume scales by the determinant", "[honeycomb]") {
  std::mt19937_64 random(20240707);
  const auto rational = [&] { return QuadraticField(Rational(Integer(static_cast<int>(random() % 19) - 9), Integer(7))); };
  int maps = 0;
  while (maps < 5) {
    std::array<std::array<QuadraticField, 4>, 3> m;
    for (auto& row : m)
      for (auto& x : row) x = rational();
    const QuadraticField det = m[0][0] * (m[1][1] * m[2][2] - m[1][2] * m[2][1]) -
                               m[0][1] * (m[1][0] * m[2][2] - m[1][2] * m[2][0]) +
                               m[0][2] * (m[1][0] * m[2][1] - m[1][1] * m[2][0]);
    if (det.sign() <= 0) continue;
    ++maps;
    const auto apply = [&](const auto& p) {
      const auto row = [&](std::size_t i) {
        return m[i][0] * QuadraticField(p.x) + m[i][1] * QuadraticField(p.y) + m[i][2] * QuadraticField(p.z) + m[i][3];
      };
      return Point3<QuadraticField>{row(0), row(1), row(2)};
    };
    test::Solid image = test::cube();
    for (auto& p : image.points) p = apply(p);
    auto level = honeycomb_start<Rational>(test::body_of(test::cube()));
    auto mapped = honeycomb_start<Rational>(test::body_of(image));
    const CutPolicy policy = golden_policy("lambda(a->b) = (1+(3a+5b) mod 7)/16 at level 0");
    for (int l = 0; l < 2; ++l) {
      auto a = honeycomb_step(level, policy), b = honeycomb_step(mapped, policy);
      CHECK(a.figures.min_gap == b.figures.min_gap);
      level = std::move(a.level);
      mapped = std::move(b.level);
    }
    for (std::size_t v = 0; v < level.points.size(); ++v) {
      const auto p = apply(level.points[v]);
      REQUIRE(p == Point3<QuadraticField>{mapped.points[v].x, mapped.points[v].y, mapped.points[v].z});
    }
    CHECK(exact_volume(to_plane_body(level)) * det == exact_volume(to_plane_body(mapped)));
  }
}

std::string refusal(const PlaneBody& body, const CutPolicy& policy) {
  try {
    (void)honeycomb_step(honeycomb_start<Rational>(body), policy);
  } catch (const InvalidInput& e) {
    return e.code();
  }
  return "none";
}

TEST_CASE("thresholds of the conditions are decided exactly", "[honeycomb]") {
  const PlaneBody tetrahedron = test::body_of(test::tetrahedron()), cube = test::body_of(test::cube());
  const Rational third(Integer(1), Integer(3)), tiny = Rational(1).scaled(-200);
  CHECK(refusal(tetrahedron, SizePolicy{{QuadraticField(third)}}) == "TriangleOvercut");
  CHECK(refusal(tetrahedron, SizePolicy{{QuadraticField(third - tiny)}}) == "TriangleOvercut");
  CHECK(refusal(tetrahedron, SizePolicy{{QuadraticField(third + tiny)}}) == "none");
  CHECK(refusal(tetrahedron, constant("1/2")) == "ParameterOutOfRange");
  CHECK(refusal(cube, constant("0")) == "QuadCollapse");
  CHECK(refusal(cube, SizePolicy{{QuadraticField(tiny)}}) == "none");
  CHECK(refusal(cube, constant("-1/1000")) == "ParameterOutOfRange");
  CHECK(refusal(cube, SizePolicy{{QuadraticField(Rational(Integer(1), Integer(2)) - tiny)}}) == "none");
}

TEST_CASE("the gap of a triangle is the closed form (d.1)", "[honeycomb]") {
  const auto level = honeycomb_start<Rational>(test::body_of(test::tetrahedron()));
  const auto lambda = [](std::uint32_t a, std::uint32_t b) {
    return Rational(Integer(static_cast<int>(36 + (3 * a + 5 * b) % 7)), Integer(100));
  };
  const HalfEdgePolicy policy = [&](const HoneycombMap& map, HalfEdgeId h) {
    const auto i = static_cast<std::uint32_t>(h);
    return QuadraticField(lambda(map.origin(i), map.target(i)));
  };
  const auto step = honeycomb_step(level, CutPolicy(policy));
  const auto odds = [](const Rational& x) { return x / (Rational(1) - x); };
  std::optional<Rational> least;
  for (std::uint32_t f = 0; f < 4; ++f) {
    for (std::uint32_t j = 0; j < 3; ++j) {
      const std::uint32_t s = level.map.facet_start(f);
      std::array<Rational, 3> A, B;
      for (std::uint32_t i = 0; i < 3; ++i) {
        const std::uint32_t h = s + (i + j) % 3;
        A[i] = odds(lambda(level.map.origin(h), level.map.target(h)));
        B[i] = odds(lambda(level.map.target(h), level.map.origin(h)));
      }
      // (b.1) and (d.1) for edge 0 of the rotated facet: j − 1 is 2.
      const Rational one(1), k0 = one - A[0] * B[0], k1 = one - A[1] * B[1];
      const Rational dv = (one + A[1]) * k0 + (one + B[0]) * (B[2] + A[0] * A[1]);
      const Rational du = (one + B[0]) * k1 + (one + A[1]) * (A[2] + B[1] * B[0]);
      const Rational st = A[0] * B[0] + A[1] * B[1] + A[2] * B[2] + A[0] * A[1] * A[2] + B[0] * B[1] * B[2];
      const Rational gap = (one + A[1]) * (one + B[0]) * (st - one) / (dv * du);
      if (!least || gap < *least) least = gap;
    }
  }
  REQUIRE(least);
  CHECK(step.figures.min_gap == *least);
}

/// One of the regular n-gons of a solid, and (2cos(π/n))², by which (17) and (19) are rational expressions.
struct RegularPolygon {
  std::size_t n;
  HoneycombLevel<QuadraticField> level;
  QuadraticField four_cos2;
};

std::vector<RegularPolygon> regular_polygons() {
  const nlohmann::json data = test::golden();
  const auto start = [](const test::Solid& s) { return honeycomb_start<QuadraticField>(test::body_of(s)); };
  std::vector<RegularPolygon> out = {{3, start(test::tetrahedron()), number("1")}, {4, start(test::cube()), number("2")}};
  for (const auto& closed : data.at("closed")) {
    if (closed.at("name") == "dodecahedron") out.push_back({5, start(test::solid(closed.at("initial"))), number("3/2+1/2*sqrt5")});
  }
  // The static step of the cube has regular hexagons.
  out.push_back({6, honeycomb_step(start(test::cube()), static_policy_sqrt5()).level, number("3")});
  return out;
}

TEST_CASE("regular polygons: scale (17), area (18) and u = v (19), exactly, for n = 3, 4, 5, 6", "[honeycomb]") {
  const QuadraticField one(1), two(2), four(4);
  const auto minus = [](const auto& p, const auto& q) { return Point3<QuadraticField>{p.x - q.x, p.y - q.y, p.z - q.z}; };
  const auto dot = [](const auto& p, const auto& q) { return p.x * q.x + p.y * q.y + p.z * q.z; };
  const auto mix = [](const QuadraticField& x, const auto& p, const auto& q) {
    const QuadraticField y = QuadraticField(1) - x;
    return Point3<QuadraticField>{x * p.x + y * q.x, x * p.y + y * q.y, x * p.z + y * q.z};
  };
  std::set<std::size_t> seen;
  for (const RegularPolygon& polygon : regular_polygons()) {
    const HoneycombMap& map = polygon.level.map;
    for (const char* text : {"2/5", "9/20", "11/30"}) {
      CAPTURE(polygon.n, text);
      const QuadraticField beta = number(text);
      const auto next = honeycomb_step(polygon.level, constant(text)).level;
      // (17) squared, with sin² = 1 − cos².
      const QuadraticField cos2 = polygon.four_cos2 / four;
      const QuadraticField numerator = one - two * (one - beta) * (one - cos2);
      const QuadraticField scale2 = numerator * numerator / cos2;
      const QuadraticField u = (one - two * beta) / (one - beta) / polygon.four_cos2;
      for (std::uint32_t f = 0; f < map.facet_count(); ++f) {
        if (map.facet_size(f) != polygon.n) continue;
        const std::uint32_t start = map.facet_start(f), n = map.facet_size(f);
        QuadraticField before, after;  // sums of squared areas of corner triangles, which scale by σ² = a⁴
        for (std::uint32_t j = 0; j < n; ++j) {
          const auto corner = [&](std::uint32_t i) -> const auto& { return polygon.level.points[map.origin(start + (j + i) % n)]; };
          const auto fresh = [&](std::uint32_t i) -> const auto& { return next.points[next.map.origin(next.map.facet_start(f) + (j + i) % n)]; };
          const auto edge = minus(corner(1), corner(0)), shrunk = minus(fresh(1), fresh(0));
          CHECK(dot(shrunk, shrunk) == scale2 * dot(edge, edge));
          // (5): q_j on the cut segments of corners j and j + 1.
          const auto near_before = mix(beta, corner(0), corner(n - 1)), near_after = mix(beta, corner(0), corner(1));
          CHECK(mix(u, near_before, near_after) == next.points[start + j]);
          const auto next_before = mix(beta, corner(1), corner(0)), next_after = mix(beta, corner(1), corner(2));
          CHECK(mix(u, next_after, next_before) == next.points[start + j]);
          const auto cross_norm = [&](const auto& p, const auto& q) { return dot(p, p) * dot(q, q) - dot(p, q) * dot(p, q); };
          before += cross_norm(edge, minus(corner(2), corner(1)));
          after += cross_norm(shrunk, minus(fresh(2), fresh(1)));
        }
        CHECK(after == scale2 * scale2 * before);
        seen.insert(polygon.n);
      }
    }
  }
  CHECK(seen == std::set<std::size_t>{3, 4, 5, 6});
}

TEST_CASE("planes are kept, points lie on their planes, and bodies round-trip", "[honeycomb]") {
  auto level = honeycomb_start<Rational>(test::body_of(test::tetrahedron()));
  for (int l = 0; l < 3; ++l) {
    auto step = honeycomb_step(level, static_policy_rational());
    for (std::size_t f = 0; f < level.planes.size(); ++f) REQUIRE(step.level.planes[f] == level.planes[f]);
    level = std::move(step.level);
  }
  for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) {
    const auto& p = level.planes[f];
    for (std::uint32_t i = 0; i < level.map.facet_size(f); ++i) {
      const auto& x = level.points[level.map.origin(level.map.facet_start(f) + i)];
      REQUIRE(p.a * x.x + p.b * x.y + p.c * x.z == p.d);
    }
  }
  const PlaneBody body = to_plane_body(level);
  for (std::size_t v = 0; v < level.points.size(); ++v) REQUIRE(rational_vertex(body, make_id<VertexId>(v)) == level.points[v]);
  PlaneBody moved = body;
  moved.scale = 3;
  moved.shift = {Rational(1), Rational(Integer(-5), Integer(4)), Rational(0)};
  const auto started = honeycomb_start<QuadraticField>(moved);
  CHECK(started.points[5].y == QuadraticField(Rational(8) * level.points[5].y - Rational(Integer(5), Integer(4))));
}

}  // namespace
}  // namespace hexact
