// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/parameter_document.hpp"

#include "exact/honeycomb_golden.hpp"

#include <catch2/catch.hpp>

namespace hexact {
namespace {

using test::number;

TEST_CASE("documents override edges and sizes level by level", "[parameters]") {
  const PlaneBody cube = test::body_of(test::cube());
  const HoneycombMap map(cube.loops, 8);
  ParameterDocument document;
  document.levels.push_back({0, {{4, number("1/3")}}, {{0, 1, number("1/5"), number("1/7")}}});
  const auto schedule = [&] { return document_policy(document, Arithmetic::rational, cube); };
  const CutPolicy policy = schedule()(map);
  for (std::uint32_t h = 0; h < map.half_edge_count(); ++h) {
    const bool forward = map.origin(h) == 0 && map.target(h) == 1, backward = map.origin(h) == 1 && map.target(h) == 0;
    CHECK(asked_parameter(map, policy, h) == number(forward ? "1/5" : backward ? "1/7" : "1/3"));
  }
  const HoneycombMap next = map.refined();
  CHECK(std::get<SizePolicy>(schedule()(next)).for_size(4) == number("1/4"));

  ParameterDocument broken = document;
  broken.levels[0].edges[0].b = 7;  // not an edge of the cube
  CHECK_THROWS_AS(document_policy(broken, Arithmetic::rational, cube)(map), InvalidInput);
  broken = document;
  broken.levels[0].edges.push_back({1, 0, number("1/5"), number("1/7")});
  CHECK_THROWS_AS(document_policy(broken, Arithmetic::rational, cube)(map), InvalidInput);
  broken = document;
  broken.levels.push_back({0, {}, {}});
  CHECK_THROWS_AS(document_policy(broken, Arithmetic::rational, cube), InvalidInput);
  broken = document;
  broken.default_policy = "tangent=sphere";
  CHECK_THROWS_AS(document_policy(broken, Arithmetic::rational, cube)(map), InvalidInput);
  broken.default_policy = "nonsense";
  CHECK_THROWS_AS(document_policy(broken, Arithmetic::rational, cube), InvalidInput);
}

TEST_CASE("planes touch the hull of points", "[parameters]") {
  const PlanePolicy policy = tangent_policy(std::vector<Point3<double>>{{1, 2, 3}, {-4, 0, 0}, {0, 0, 5}});
  CHECK(policy.offset({1, 0, 0}) == 1);
  CHECK(policy.offset({-2, 0, 0}) == 8);
  CHECK(policy.offset({1, 1, 1}) == 6);
  CHECK(policy.normal(CornerView{{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {}, 0}) == std::array<double, 3>{1, 1, 1});
  CHECK_THROWS_AS(tangent_policy(std::vector<Point3<double>>{}), InvalidInput);
}

}  // namespace
}  // namespace hexact
