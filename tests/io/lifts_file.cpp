// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/io/lifts_file.hpp"

#include "hexact/exact/lift_rules.hpp"
#include "hexact/kernel/errors.hpp"
#include "solid_samples.hpp"

#include <catch2/catch.hpp>

namespace hexact::io {
namespace {

std::string with(const std::string& rest) { return R"({"hexact": "lifts", "version": 1)" + rest + "}"; }

TEST_CASE("a lifts document is read exactly", "[lifts]") {
  const LiftDocument d = parse_lifts(with(R"(, "default": "auto", "factors": [1, "2/3"],
      "levels": [{"level": 2, "edges": [[7, 0, 0.1]]}, {"level": 3, "lifts": [1, "1/3", 123456789012345678901234567890]}])"), "x.json");
  CHECK(d.automatic_otherwise);
  CHECK(d.factors == std::vector<Rational>{Rational(1), Rational(Integer(2), Integer(3))});
  REQUIRE(d.levels.size() == 2);
  CHECK(d.levels[0].level == 2);
  CHECK(d.levels[0].edges->at(0).a == 7);
  CHECK(d.levels[0].edges->at(0).lift.str() == "1/10");
  CHECK_FALSE(d.levels[1].edges);
  CHECK(d.levels[1].lifts.at(2).str() == "123456789012345678901234567890");
}

TEST_CASE("what is no lifts document is refused with the path", "[lifts]") {
  const auto path = [](const std::string& text) {
    try {
      (void)parse_lifts(text, "x.json");
    } catch (const ParseError& e) {
      CHECK(e.file() == "x.json");
      return e.element();
    }
    return std::string("accepted");
  };
  CHECK(path(with("")) == "accepted");
  CHECK(path("[1]") == "");
  CHECK(path(R"({"hexact": "parameters", "version": 1})") == "");
  CHECK(path(with(R"(, "colour": 1)")) == "/colour");
  CHECK(path(with(R"(, "default": "fair")")) == "/default");
  CHECK(path(with(R"(, "factors": 3)")) == "/factors");
  CHECK(path(with(R"(, "factors": [1, "x"])")) == "/factors/1");
  CHECK(path(with(R"(, "factors": ["1+1*sqrt5"])")) == "/factors/0");
  CHECK(path(with(R"(, "levels": [{"lifts": []}])")) == "/levels/0");
  CHECK(path(with(R"(, "levels": [{"level": 0}])")) == "/levels/0");
  CHECK(path(with(R"(, "levels": [{"level": 0, "lifts": [], "edges": []}])")) == "/levels/0");
  CHECK(path(with(R"(, "levels": [{"level": -1, "lifts": []}])")) == "/levels/0/level");
  CHECK(path(with(R"(, "levels": [{"level": 0, "edges": [[0, 1]]}])")) == "/levels/0/edges/0");
  CHECK(path(with(R"(, "levels": [{"level": 0, "edges": [[0, 1, null]]}])")) == "/levels/0/edges/0/2");
}

TEST_CASE("lifts of a document are those of its edges, and what does not fit the solid is named", "[lifts][chamfer]") {
  const ChamferLevel cube = chamfer_start(samples::cube());
  const HoneycombMap& map = cube.surface.map;
  const EdgeNumbering edges = number_edges(map);
  const auto entry = [&](std::uint32_t e, const std::string& lift) {
    const std::uint32_t h = edges.half_edge[e];
    return "[" + std::to_string(map.target(h)) + ", " + std::to_string(map.origin(h)) + ", " + lift + "]";
  };
  std::string all;
  for (std::uint32_t e = 0; e < 12; ++e) all += (e == 0 ? "" : ", ") + entry(e, "\"1/" + std::to_string(3 + e % 2) + "\"");
  const auto finding = [&](const std::string& text) {
    try {
      (void)chamfer_step(cube, document_lifts(parse_lifts(text, "x.json"), automatic_lifts(constant_keep(0.5))));
    } catch (const InvalidInput& e) {
      return e.code() + " " + e.findings().front().element;
    }
    return std::string("accepted");
  };
  const auto level = [&](const std::string& list) { return with(R"(, "levels": [{"level": 0, "edges": [)" + list + "]}]"); };
  CHECK(finding(level(all)) == "accepted");
  const ChamferLevel cut = chamfer_step(cube, document_lifts(parse_lifts(level(all), "x.json"), automatic_lifts(constant_keep(0.5))));
  for (std::uint32_t e = 0; e < 12; ++e) {
    // x + y <= 2 − τ: the offset over the largest entry of the normal, in file coordinates.
    const PlaneBody body = to_plane_body(cut.surface);
    const Plane<Integer> p = body.planes[6 + e];
    const auto magnitude = [](const Integer& x) { return x.sign() < 0 ? -x : x; };
    const Rational one(std::max({magnitude(p.a), magnitude(p.b), magnitude(p.c)}));
    CHECK(Rational(p.d).scaled(body.scale) / one == Rational(2) - Rational(Integer(1), Integer(3 + static_cast<int>(e % 2))));
  }
  CHECK(finding(level(all + ", " + entry(3, "1"))).starts_with("BadLifts edge "));
  CHECK(finding(level("[0, 7, 1]")) == "BadLifts edge 0-7");
  CHECK(finding(level("[0, 99, 1]")) == "BadLifts edge 0-99");
  CHECK(finding(level(entry(0, "1"))).starts_with("BadLifts edge "));
  CHECK(finding(with(R"(, "levels": [{"level": 0, "lifts": [1, 1]}])")) == "BadLifts ");
  CHECK(finding(with("")) == "BadLifts level 0");
  CHECK(finding(with(R"(, "default": "auto")")) == "accepted");
  CHECK(finding(with(R"(, "levels": [{"level": 0, "lifts": []}, {"level": 0, "lifts": []}])")) == "BadLifts level 0");
}

}  // namespace
}  // namespace hexact::io
