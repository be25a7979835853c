// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/honeycomb.hpp"

#include "exact/honeycomb_golden.hpp"
#include "hexact/exact/volume.hpp"

#include <catch2/catch.hpp>

#include <map>
#include <random>
#include <set>

namespace hexact {
namespace {

using test::number;

CutPolicy constant(const char* beta) { return SizePolicy{{number(beta)}}; }

/// The policies that the golden file names in words.
CutPolicy golden_policy(const std::string& name) {
  if (name == "static") return static_policy_sqrt5();
  if (name == "static_rational") return static_policy_rational();
  if (name == "uniform 1/4") return constant("1/4");
  if (name == "beta4=2/5, beta6=1/10") {
    return SizePolicy{{number("0"), number("0"), number("0"), number("2/5"), number("2/5"), number("2/5"), number("1/10")}};
  }
  REQUIRE(name == "lambda(a->b) = (1+(3a+5b) mod 7)/16 at level 0");
  return HalfEdgePolicy([](const HoneycombMap& map, HalfEdgeId h) {
    const auto i = static_cast<std::uint32_t>(h);
    return QuadraticField(Rational(Integer(1 + static_cast<int>((3 * map.origin(i) + 5 * map.target(i)) % 7)), Integer(16)));
  });
}

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
  }
}

/// Does the case need √5 in its coordinates or in its parameters?
bool needs_root(const nlohmann::json& closed, const PlaneBody& body) {
  return body.field == Field::sqrt5 ||
         (closed.at("parameters") == "static" && closed.at("levels")[0].at("face_sizes").contains("5"));
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

TEST_CASE("regular polygons shrink by (17): a3 = 3β − 1, σ4 = 2β²", "[honeycomb]") {
  const auto squared_edge = [](const HoneycombLevel<Rational>& l, std::uint32_t f) {
    const std::uint32_t h = l.map.facet_start(f);
    const auto &p = l.points[l.map.origin(h)], &q = l.points[l.map.target(h)];
    const Rational x = p.x - q.x, y = p.y - q.y, z = p.z - q.z;
    return x * x + y * y + z * z;
  };
  for (const char* text : {"2/5", "9/20", "11/30"}) {
    const Rational beta = number(text).rational_part();
    const auto t = honeycomb_start<Rational>(test::body_of(test::tetrahedron()));
    const Rational a3 = Rational(3) * beta - Rational(1);
    CHECK(squared_edge(honeycomb_step(t, constant(text)).level, 0) == a3 * a3 * squared_edge(t, 0));
    const auto c = honeycomb_start<Rational>(test::body_of(test::cube()));
    CHECK(squared_edge(honeycomb_step(c, constant(text)).level, 0) == Rational(2) * beta * beta * squared_edge(c, 0));
  }
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
