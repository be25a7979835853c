// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/kernel/midedge_part.hpp"

#include "midedge_samples.hpp"

#include <catch2/catch.hpp>

using namespace hexact;
using namespace hexact::midedge_samples;

namespace {

Level cut(const Level& level, const std::vector<std::uint32_t>& facets, unsigned rings) {
  MidedgePart part = midedge_part(level.map, facets, rings);
  Level result{std::move(part.map), {}};
  for (const std::uint32_t v : part.vertices) result.points.push_back(level.points[v]);
  return result;
}

std::vector<Point> corners(const Level& level, std::uint32_t f) {
  std::vector<Point> points;
  for (const std::uint32_t v : level.map.loop(f)) points.push_back(level.points[v]);
  return points;
}

}  // namespace

TEST_CASE("a part has its facets first and as many rings as asked", "[midedge]") {
  const Level level = grid(7, 7, wave);
  for (const unsigned rings : {0, 1, 2, 3}) {
    const MidedgePart part = midedge_part(level.map, std::array<std::uint32_t, 1>{24}, rings);
    CHECK(counts(part.map)[2] == (2 * rings + 1) * (2 * rings + 1));
    CHECK(counts(part.map)[0] == (2 * rings + 2) * (2 * rings + 2));
    for (std::uint32_t i = 0; i < 4; ++i) CHECK(part.vertices[part.map.loop(0)[i]] == level.map.loop(24)[i]);
  }
  CHECK(counts(midedge_part(level.map, std::array<std::uint32_t, 1>{6}, 2).map)[2] == 9);
  CHECK(midedge_part(golden_mesh("cube").map, std::array<std::uint32_t, 1>{3}, 2).map.closed());
}

TEST_CASE("a vertex around which a part hangs not together is doubled", "[midedge]") {
  const Level level = grid(3, 3, wave);
  const MidedgePart two = midedge_part(level.map, std::array<std::uint32_t, 2>{4, 0}, 0);
  CHECK(counts(two.map) == std::vector<std::size_t>{8, 8, 2});
  CHECK(two.vertices[two.map.loop(0)[0]] == two.vertices[two.map.loop(1)[2]]);
  CHECK(corners(cut(level, {4, 0}, 0), 1) == corners(level, 0));
  // A ring of eight facets around a hole keeps its four inner vertices.
  CHECK(counts(midedge_part(level.map, std::array<std::uint32_t, 8>{0, 1, 2, 3, 5, 6, 7, 8}, 0).map) == std::vector<std::size_t>{16, 24, 8});
}

TEST_CASE("with two rings around them facets are refined as in the whole, for ever", "[midedge]") {
  auto samples = open_samples();
  samples.emplace("tower", tower(5));
  for (const auto& [name, whole_input] : samples) {
    for (const MidedgeBoundary policy : {MidedgeBoundary::dual, MidedgeBoundary::close}) {
      CAPTURE(name, int(policy));
      const auto two_steps = [&](const Level& level) {
        return policy == MidedgeBoundary::dual ? midedge_double_step(level, MidedgeRule::six_point) : refined(level, 2, MidedgeRule::six_point, policy);
      };
      const auto last = static_cast<std::uint32_t>(whole_input.map.facet_count() - 1);
      const std::vector<std::uint32_t> facets = last == 0 ? std::vector<std::uint32_t>{0} : std::vector<std::uint32_t>{last, 0};
      Level whole = two_steps(whole_input), part = cut(whole, facets, 2);
      for (int n = 0; n < 3; ++n) {
        whole = two_steps(whole);
        part = two_steps(part);
        for (std::uint32_t i = 0; i < facets.size(); ++i) REQUIRE(corners(part, i) == corners(whole, facets[i]));
        part = cut(part, facets.size() == 2 ? std::vector<std::uint32_t>{0, 1} : std::vector<std::uint32_t>{0}, 2);
      }
    }
  }
}

TEST_CASE("parts of meshes with pinched vertices are manifolds", "[midedge]") {
  const Level level = refined(grid(4, 3, wave), 3, MidedgeRule::simple, MidedgeBoundary::drop);
  REQUIRE(level.map.pinched_vertex_count() > 0);
  for (std::uint32_t f = 0; f < level.map.facet_count(); ++f) {
    const MidedgePart part = midedge_part(level.map, std::array{f}, 2);
    CHECK(part.map.pinched_vertex_count() == 0);
    CHECK(part.map.facet_size(0) == level.map.facet_size(f));
  }
}
