// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/kernel/honeycomb_double.hpp"

#include "hexact/kernel/honeycomb_statistics.hpp"

#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include <cmath>

using namespace hexact;

namespace {

DoubleLevel cube() {
  FacetLoops loops;
  for (const auto& loop : {std::initializer_list<int>{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
    for (const int v : loop) loops.add_corner(make_id<VertexId>(static_cast<std::size_t>(v)));
    loops.close_loop();
  }
  RawVector<Point3<double>> points;
  for (int i = 0; i < 8; ++i) points.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  return {HoneycombMap(loops, 8), points};
}

const SizeTable kStatic = {0, 0, 0, 0.4, 0.25, 0.11294200180, 0};

double volume(const DoubleLevel& level) {
  double sum = 0;
  for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) {
    const std::uint32_t start = level.map.facet_start(f);
    const auto& p = level.points[level.map.origin(start)];
    for (std::uint32_t h = start + 1; h + 1 < start + level.map.facet_size(f); ++h) {
      const auto &q = level.points[level.map.origin(h)], &r = level.points[level.map.origin(h + 1)];
      sum += p.x * (q.y * r.z - q.z * r.y) + p.y * (q.z * r.x - q.x * r.z) + p.z * (q.x * r.y - q.y * r.x);
    }
  }
  return sum / 6;
}

}  // namespace

TEST_CASE("the double engine has the exact volumes of the cube to rounding", "[double]") {
  DoubleLevel level = cube();
  const double expected[] = {4, 33877.0 / 9680, 3.2985536157897286, 3.2340978399304894};
  for (const double v : expected) {
    level = double_step(std::move(level), kStatic);
    CHECK(volume(level) == Approx(v).epsilon(1e-13));
  }
}

TEST_CASE("a table and a function of the same parameters give the same points", "[double]") {
  const DoubleParameter function = [](const HoneycombMap& map, HalfEdgeId id) {
    const auto h = static_cast<std::uint32_t>(id);
    return kStatic[std::min<std::size_t>(std::min(map.facet_size(map.facet(h)), map.facet_size(map.facet(map.twin(h)))), 6)];
  };
  DoubleLevel a = cube(), b = cube();
  for (int l = 0; l < 4; ++l) {
    a = double_step(std::move(a), kStatic);
    b = double_step(std::move(b), function);
  }
  CHECK(a.points == b.points);
}

TEST_CASE("one static step of the cube is the truncated octahedron, measured", "[double]") {
  const DoubleLevel level = double_step(cube(), kStatic);
  const auto normals = newell_normals(level.map, level.points);
  const HoneycombStatistics s = measure(level.map, level.points, normals);
  CHECK(s.longest_edge == Approx(s.shortest_edge));
  CHECK(s.longest_edge == Approx(std::sqrt(2.0) / 2));
  CHECK(s.max_facet_diameter == Approx(std::sqrt(2.0)));
  const double pi = std::acos(-1.0);
  CHECK(s.max_normal_angle_deg == Approx(std::acos(1.0 / 3) * 180 / pi));  // between two hexagons
  CHECK(s.median_normal_angle_deg == Approx(std::acos(1 / std::sqrt(3.0)) * 180 / pi));
}

TEST_CASE("doubles and measures do not depend on the number of threads", "[double]") {
  const auto run = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    DoubleLevel level = cube();
    for (int l = 0; l < 8; ++l) level = double_step(std::move(level), kStatic);
    return level;
  };
  CHECK(run(1).points == run(2).points);
}
