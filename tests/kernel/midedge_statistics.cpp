// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/kernel/midedge_statistics.hpp"

#include "hexact/kernel/midedge.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <limits>

using namespace hexact;

namespace {

using DoublePoints = std::vector<Point3<double>>;

/// A box of 1 × 2 × 3, so that no two kinds of edges are equal.
MidedgeLevel<double> box() {
  FacetLoops loops;
  for (const auto& loop : {std::initializer_list<int>{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
    for (const int v : loop) loops.add_corner(make_id<VertexId>(static_cast<std::size_t>(v)));
    loops.close_loop();
  }
  MidedgeLevel<double> level{MidedgeMap(loops, 8), {}};
  for (int i = 0; i < 8; ++i) level.points.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 2.0 : -2.0, i & 4 ? 3.0 : -3.0});
  return level;
}

DoublePoints times_power_of_two(const MidedgeLevel<double>& level, int exponent) {
  DoublePoints points;
  for (const auto& p : level.points) points.push_back({std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)});
  return points;
}

HoneycombStatistics figures(const MidedgeMap& map, const DoublePoints& points) { return measure(map, points, newell_normals(map, points)); }

}  // namespace

TEST_CASE("figures of a level do not depend on the unit of length", "[midedge]") {
  const MidedgeLevel<double> level = midedge_step(box(), MidedgeRule::six_point, MidedgeBoundary::close);
  const HoneycombStatistics expected = figures(level.map, times_power_of_two(level, 0));
  CHECK(expected.max_normal_angle_deg > 10);
  CHECK(expected.max_facet_diameter > expected.longest_edge);
  for (const int exponent : {-1000, -665, -342, -170, 170, 342, 665, 1000, 1020}) {
    const HoneycombStatistics s = figures(level.map, times_power_of_two(level, exponent));
    CHECK(s.max_normal_angle_deg == Approx(expected.max_normal_angle_deg).epsilon(1e-12));
    CHECK(s.median_normal_angle_deg == Approx(expected.median_normal_angle_deg).epsilon(1e-12));
    CHECK(std::ldexp(s.longest_edge, -exponent) == Approx(expected.longest_edge).epsilon(1e-12));
    CHECK(std::ldexp(s.shortest_edge, -exponent) == Approx(expected.shortest_edge).epsilon(1e-12));
    CHECK(std::ldexp(s.max_facet_diameter, -exponent) == Approx(expected.max_facet_diameter).epsilon(1e-12));
  }
}

TEST_CASE("facets whose corners are further apart than the largest double have normals, and no length", "[midedge]") {
  const MidedgeLevel<double> level = box();
  const HoneycombStatistics s = figures(level.map, times_power_of_two(level, 1022));
  CHECK(s.max_normal_angle_deg == Approx(90));
  CHECK(s.longest_edge == std::numeric_limits<double>::infinity());
  CHECK(s.shortest_edge == std::ldexp(1.0, 1023));
}

TEST_CASE("a facet without area has no normal", "[midedge]") {
  const MidedgeLevel<double> level = box();
  for (const auto& n : newell_normals(level.map, DoublePoints(8, {1e300, 1, 1e-300}))) CHECK((n.x == 0 && n.y == 0 && n.z == 0));
}
