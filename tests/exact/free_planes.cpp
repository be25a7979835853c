// SPDX-License-Identifier: GPL-3.0-or-later
#include "exact/honeycomb_golden.hpp"
#include "hexact/exact/honeycomb.hpp"
#include "hexact/exact/policies.hpp"
#include "hexact/exact/snapped_honeycomb.hpp"

#include <catch2/catch.hpp>

#include <cmath>

namespace hexact {
namespace {

std::string refusal(const PlaneBody& body, const CutPolicy& policy) {
  try {
    (void)honeycomb_step(honeycomb_start<Rational>(body), policy);
  } catch (const InvalidInput& e) {
    CHECK(!e.findings().front().element.empty());
    return e.code();
  }
  return "none";
}

TEST_CASE("planes tangent to a sphere keep the lattice of cube and dodecahedron", "[free planes]") {
  const nlohmann::json data = test::golden();
  for (const std::size_t i : {1U, 2U}) {
    const PlaneBody body = test::body_of(test::solid(data.at("closed")[i].at("initial")));
    auto level = honeycomb_start<QuadraticField>(body);
    const PolicySchedule schedule = parse_policy("tangent=sphere", Arithmetic::qsqrt5, body);
    for (int l = 0; l < 3; ++l) {
      auto step = honeycomb_step(level, schedule(level.map));
      CHECK(step.figures.min_gap.sign() > 0);
      CHECK(step.figures.delta.sign() > 0);
      level = std::move(step.level);
    }
    CHECK(level.map.level() == 3);
  }
}

TEST_CASE("the level-3 cube of tangent planes has the angle that the specification lists", "[free planes]") {
  const PlaneBody body = test::body_of(test::cube());
  auto level = honeycomb_start<Rational>(body);
  const PolicySchedule schedule = parse_policy("tangent=sphere", Arithmetic::rational, body);
  for (int l = 0; l < 3; ++l) level = honeycomb_step(level, schedule(level.map)).level;
  // The result is an exact convex body by the independent signs of the certificate too.
  const PlaneBody planes = to_plane_body(level);
  CHECK(sign_violations(level.map, planes.planes).empty());
  double largest = 0;
  for (std::uint32_t h = 0; h < level.map.half_edge_count(); ++h) {
    const auto unit = [&](std::uint32_t f) {
      const auto& p = level.planes[f];
      const double a = p.a.to_double(), b = p.b.to_double(), c = p.c.to_double(), n = std::sqrt(a * a + b * b + c * c);
      return std::array<double, 3>{a / n, b / n, c / n};
    };
    const auto m = unit(level.map.facet(h)), n = unit(level.map.facet(level.map.twin(h)));
    largest = std::max(largest, std::acos(m[0] * n[0] + m[1] * n[1] + m[2] * n[2]) * 180 / std::acos(-1.0));
  }
  CHECK(largest == Approx(23.87).margin(0.005));
}

TEST_CASE("the tetrahedron is refused at level 1", "[free planes]") {
  const PlaneBody tetrahedron = test::body_of(test::tetrahedron());
  const HoneycombMap map(tetrahedron.loops, 4);
  CHECK(refusal(tetrahedron, parse_policy("tangent=sphere", Arithmetic::rational, tetrahedron)(map)) == "LatticeLost");
}

TEST_CASE("planes that miss their vertex or cut too deep are refused, shallow ones accepted", "[free planes]") {
  const PlaneBody cube = test::body_of(test::cube());
  const auto at_distance = [](double share) {
    return PlanePolicy{[](const CornerView& view) { return view.point; },
                       [share](const std::array<double, 3>& n) {
                         // A support function: share times that of the cube.
                         return share * (std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2]));
                       }};
  };
  // λ = (3·share − 1)/2: at 2/3 the cuts meet in the middle of the edges, at 1/3 the squares collapse.
  CHECK(refusal(cube, at_distance(1.0)) == "LatticeLost");
  CHECK(refusal(cube, at_distance(1.5)) == "LatticeLost");
  CHECK(refusal(cube, at_distance(0.7)) == "LatticeLost");
  CHECK(refusal(cube, at_distance(0.6)) == "none");
  CHECK(refusal(cube, at_distance(0.1)) == "LatticeLost");
}

TEST_CASE("a plane through given cut points is the step of those parameters", "[free planes]") {
  const auto level = honeycomb_start<Rational>(test::body_of(test::cube()));
  // x + y + z = 3/2 cuts the edges of the corner (1, 1, 1) with λ = 1/4; rounding outward adds at most 2^-29.
  const PlanePolicy policy{[](const CornerView& view) { return view.point; },
                           [](const std::array<double, 3>& n) {
                             return 0.5 * (std::fabs(n[0]) + std::fabs(n[1]) + std::fabs(n[2]));
                           }};
  const auto free = honeycomb_step(level, CutPolicy(policy));
  const auto parametric = honeycomb_step(level, CutPolicy(SizePolicy{{QuadraticField(Rational(Integer(1), Integer(4)))}}));
  for (std::size_t v = 0; v < free.level.points.size(); ++v) {
    CHECK(free.level.points[v].x.to_double() == Approx(parametric.level.points[v].x.to_double()).margin(1e-8));
  }
  CHECK(free.figures.delta > Rational(Integer(49), Integer(100)));
  CHECK(free.figures.delta <= parametric.figures.delta);
}

}  // namespace
}  // namespace hexact
