// SPDX-License-Identifier: GPL-3.0-or-later
// JSON documents against the schemas that are installed with the program, by Python's jsonschema.
#include "program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>

using namespace hexact;
using program::run;

namespace {

const std::string kSchemas = HEXACT_SOURCE_DIR "/io/schema/";

bool is_valid(const program::Folder& folder, const std::string& document, const std::string& kind) {
  const program::Run result = run(folder, "python3 -W ignore -m jsonschema -i '" + document + "' '" + kSchemas + kind + ".schema.json'");
  CAPTURE(document, result.err);
  REQUIRE((result.status == 0 || (!result.err.empty() && result.err.find("Traceback") == std::string::npos && result.err.find("No module") == std::string::npos)));
  return result.status == 0;
}

}  // namespace

TEST_CASE("parameters: what the schema accepts the program reads, what it rejects the program rejects", "[program][schema]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make cube -o cube.planes").status == 0);
  const std::string head = R"({"hexact": "parameters", "version": 1)";
  const std::vector<std::pair<std::string, bool>> documents = {
      {head + "}", true},
      {head + R"(, "default": "constant=1/4", "levels": []})", true},
      {head + R"(, "levels": [{"level": 0, "sizes": {"4": "1/4"}, "edges": [[0, 1, "1/3", 0.2]]}]})", true},
      {head + R"(, "levels": [{"level": 1, "sizes": {"4": 0.25, "6": "1/16"}}]})", true},
      {head + R"(, "levels": [{"level": 0, "sizes": {"4": "25e-2"}}]})", true},
      {head + R"(, "level": []})", false},
      {R"({"hexact": "parameters"})", false},
      {R"({"hexact": "curves", "version": 1})", false},
      {R"({"hexact": "parameters", "version": 2})", false},
      {"[]", false},
      {head + R"(, "default": 3})", false},
      {head + R"(, "levels": {}})", false},
      {head + R"(, "levels": [{}]})", false},
      {head + R"(, "levels": [{"level": -1}]})", false},
      {head + R"(, "levels": [{"level": 0, "size": {}}]})", false},
      {head + R"(, "levels": [{"level": 0, "sizes": {"2": "1/4"}}]})", false},
      {head + R"(, "levels": [{"level": 0, "sizes": {"4": "a quarter"}}]})", false},
      {head + R"(, "levels": [{"level": 0, "sizes": {"4": null}}]})", false},
      {head + R"(, "levels": [{"level": 0, "edges": [[0, 1, "1/3"]]}]})", false},
      {head + R"(, "levels": [{"level": 0, "edges": [[0, 1, "1/3", "1/5", 1]]}]})", false},
      {head + R"(, "levels": [{"level": 0, "edges": [[0, -1, "1/3", "1/5"]]}]})", false},
  };
  for (const auto& [text, good] : documents) {
    CAPTURE(text);
    program::write_bytes((folder.path() / "p.json").string(), text);
    CHECK(is_valid(folder, "p.json", "parameters") == good);
    CHECK(run(folder, "\"$hexact\" subdivide cube.planes -o out.planes --levels 2 --parameters file=p.json").status == (good ? 0 : 3));
  }
}

TEST_CASE("limit-points: valid in every arithmetic, in the facets, and tight where parameters go on", "[program][schema]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make cube -o cube.planes && \"$hexact\" make dodecahedron -o dodecahedron.planes").status == 0);
  struct Case {
    std::string options;
    bool proved, tight, unsnapped;
  };
  for (const Case& test : {Case{"cube.planes", true, false, true}, Case{"cube.planes --arithmetic rational", true, true, true},
                           Case{"dodecahedron.planes --arithmetic qsqrt5", true, true, true},
                           Case{"cube.planes --arithmetic double", false, false, false},
                           Case{"cube.planes --parameters random=4", true, false, false},
                           Case{"cube.planes --parameters tangent=sphere", true, false, false},
                           Case{"cube.planes --parameters equal-u --arithmetic rational", true, true, true}}) {
    CAPTURE(test.options);
    REQUIRE(run(folder, "\"$hexact\" subdivide " + test.options + " --levels 2 -o out.off --limit-points limits.json").status == 0);
    CHECK(is_valid(folder, "limits.json", "limit-points"));
    const auto document = nlohmann::json::parse(program::read_bytes((folder.path() / "limits.json").string()));
    CHECK(document.at("proved") == test.proved);
    CHECK(document.at("facets").size() > 30);
    for (const auto& facet : document.at("facets")) {
      const auto p = facet.at("point"), plane = facet.at("plane");
      const double off = plane[0].get<double>() * p[0].get<double>() + plane[1].get<double>() * p[1].get<double>() +
                         plane[2].get<double>() * p[2].get<double>() - plane[3].get<double>();
      CHECK(std::fabs(off) < 1e-12);
      CHECK((facet.at("bound").get<double>() < 1e-12) == test.tight);
      CHECK(facet.at("bound_unsnapped").is_number() == test.unsnapped);
      if (test.unsnapped) CHECK(facet.at("bound_unsnapped").get<double>() < 1e-12);
    }
  }
}

TEST_CASE("limit-points of open Midedge meshes are valid", "[program][schema]") {
  const program::Folder folder;
  program::write_bytes((folder.path() / "g.obj").string(), "v 0 0 0\nv 1 0 0\nv 2 0 1\nv 0 1 0\nv 1 1 0\nv 2 1 1\nf 1 2 5 4\nf 2 3 6 5\n");
  for (const std::string boundary : {"dual", "close", "drop"}) {
    for (const std::string scheme : {"midedge", "midedge6"}) {
      REQUIRE(run(folder, "\"$hexact\" subdivide g.obj --scheme " + scheme + " --boundary " + boundary +
                              " --levels 2 -o o.off --limit-points l.json").status == 0);
      CHECK(is_valid(folder, "l.json", "limit-points"));
    }
  }
}

TEST_CASE("snapped limit bounds hold for the levels that the program goes on to make", "[program][schema]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make random 12 5 -o r.planes && for l in 2 4; do \"$hexact\" subdivide r.planes --levels $l -o l$l.planes "
                      "--limit-points l$l.json || exit 9; done").status == 0);
  const auto read = [&](const char* name) { return nlohmann::json::parse(program::read_bytes((folder.path() / name).string())).at("facets"); };
  const auto early = read("l2.json"), late = read("l4.json");
  for (std::size_t f = 0; f < early.size(); ++f) {
    double squares = 0;
    for (int k = 0; k < 3; ++k) squares += std::pow(early[f].at("point")[k].get<double>() - late[f].at("point")[k].get<double>(), 2);
    CHECK(std::sqrt(squares) <= early[f].at("bound").get<double>() + late[f].at("bound").get<double>());
    for (const char* key : {"facet", "level", "parent"}) CHECK(early[f].at(key) == late[f].at(key));
  }
}
