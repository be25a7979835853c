// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/sample_solids.hpp"

#include "hexact/exact/body_from_soup.hpp"
#include "hexact/exact/volume.hpp"
#include "soup_fixtures.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <fstream>
#include <set>

using namespace hexact;
using namespace hexact::fixtures;

namespace {

const nlohmann::json& golden() {
  static const nlohmann::json data = nlohmann::json::parse(std::ifstream(std::string(HEXACT_TEST_DATA) + "/phs_golden.json"));
  return data;
}

nlohmann::json stored_mesh(const std::string& section, const std::string& name) {
  for (const auto& entry : golden().at(section)) {
    if (entry.contains("initial") && entry.at("name") == name) return entry.at("initial");
  }
  throw std::runtime_error("no reference mesh " + name);
}

template <class S>
void compare(const PolygonSoup<S>& ours, const nlohmann::json& reference) {
  REQUIRE(ours.points.size() == reference.at("vertices").size());
  for (std::size_t v = 0; v < ours.points.size(); ++v) {
    CAPTURE(v);
    std::array<QuadraticField, 3> expected;
    for (std::size_t c = 0; c < 3; ++c) {
      REQUIRE(QuadraticField::parse(reference["vertices"][v][c].get<std::string>(), expected[c]));
    }
    CHECK(QuadraticField(ours.points[v].x) == expected[0]);
    CHECK(QuadraticField(ours.points[v].y) == expected[1]);
    CHECK(QuadraticField(ours.points[v].z) == expected[2]);
  }
  REQUIRE(ours.facets.size() == reference.at("faces").size());
  for (std::size_t f = 0; f < ours.facets.size(); ++f) {
    CAPTURE(f);
    std::vector<std::uint32_t> loop;
    for (VertexId v : ours.facets[f]) loop.push_back(static_cast<std::uint32_t>(v));
    CHECK(loop == reference["faces"][f].get<std::vector<std::uint32_t>>());
  }
}

Counts counts_of(const std::string& name) {
  return std::visit([](const auto& soup) { return counts(soup); }, sample_solid(name));
}

}  // namespace

TEST_CASE("samples equal the reference meshes, vertex by vertex and facet by facet", "[samples]") {
  for (const auto& [section, name, stored] :
       {std::array{"closed", "tetrahedron", "tetrahedron"}, {"closed", "cube", "cube"},
        {"closed", "dodecahedron", "dodecahedron"}, {"closed", "truncated-icosahedron", "truncated_icosahedron"},
        {"closed", "pyritohedron", "pyritohedron"}, {"closed", "random12", "random12"},
        {"closed", "random29", "random29"}, {"general", "torus", "torus_dual_10x6"}}) {
    CAPTURE(name);
    std::visit([&, s = std::string(section), n = std::string(stored)](const auto& soup) { compare(soup, stored_mesh(s, n)); },
               sample_solid(name));
  }
}

TEST_CASE("every closed sample is strictly convex, or says what it is", "[samples]") {
  for (const SampleName& sample : sample_names()) {
    CAPTURE(sample.name);
    const SoupShape shape = std::visit([](const auto& soup) { return examine_soup(soup); }, sample_solid(sample.name));
    const std::set<std::string> others{"torus", "saddle", "seven-cubes", "seven-cubes-corner", "l-prism", "u-prism", "star-prism", "frame"};
    CHECK(shape.strictly_convex == (others.count(sample.name) == 0));
    CHECK(shape.topology.manifold);
  }
  CHECK(counts_of("octahedron") == Counts{6, 12, 8});
  CHECK(counts_of("icosahedron") == Counts{12, 30, 20});
  CHECK(counts_of("cuboctahedron") == Counts{12, 24, 14});
  CHECK(counts_of("torus") == Counts{120, 180, 60});
  CHECK(counts_of("saddle") == Counts{74, 100, 27});
  CHECK(counts(grid(4, 3)) == Counts{20, 31, 12});
  CHECK(codes_thrown_by([] { (void)sample_solid("teapot"); }) == Codes{"UnknownSample"});
}

TEST_CASE("bodies of seven cubes equal the reference meshes", "[samples]") {
  const auto figures = nlohmann::json::parse(std::ifstream(std::string(HEXACT_TEST_DATA) + "/midedge_golden.json")).at("figures");
  for (const auto& [name, key] : {std::array{"seven-cubes", "seven_cubes_cross_fig21_22_reading_A"},
                                  {"seven-cubes-corner", "seven_cubes_2x2x2_minus_1_reading_B"}}) {
    const auto& input = figures.at(key).at("input");
    const auto solid = std::get<PolygonSoup<Rational>>(sample_solid(name));
    compare(solid, {{"vertices", input.at("V")}, {"faces", input.at("F")}});
    CHECK(exact_volume(std::span<const Point3<Rational>>(solid.points), solid.facets) == Rational(7));
  }
}

TEST_CASE("prisms are inscribed in the circle", "[samples]") {
  for (std::size_t n : {3u, 4u, 5u, 6u, 17u, 256u}) {
    CAPTURE(n);
    const auto solid = prism(n);
    CHECK(counts(solid) == Counts{2 * n, 3 * n, n + 2});
    CHECK(examine_soup(solid).strictly_convex);
    for (const auto& p : solid.points) CHECK(p.x * p.x + p.y * p.y == Rational(1));
  }
  CHECK(exact_volume(std::span<const Point3<Rational>>(prism(4).points), prism(4).facets) == Rational(4));
}

TEST_CASE("random solids have n facets, are simple and convex, and depend on the seed alone", "[samples]") {
  for (std::size_t n : {4u, 5u, 8u, 30u, 300u}) {
    for (std::uint64_t seed : {0u, 1u, 2u}) {
      CAPTURE(n, seed);
      const auto solid = random_solid(n, seed);
      CHECK(counts(solid) == Counts{2 * n - 4, 3 * n - 6, n});
      CHECK(convex_trivalent_findings(body_from_soup(solid)).empty());
      CHECK(random_solid(n, seed).points == solid.points);
    }
  }
  CHECK_FALSE(random_solid(8, 1).points == random_solid(8, 2).points);
}

TEST_CASE("a random solid whose polar points have coordinates near 2^345 is convex", "[samples]") {
  // Their determinants overflow doubles, which the hull's filter once took for a sign.
  CHECK(convex_trivalent_findings(body_from_soup(random_solid(28, 418))).empty());
}
