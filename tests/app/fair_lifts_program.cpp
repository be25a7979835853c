// SPDX-License-Identifier: GPL-3.0-or-later
#include "program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace hexact;

TEST_CASE("subdivide with fair lifts: rounder, certified, the same for every number of threads", "[app][fair]") {
  const program::Folder folder;
  REQUIRE(program::run(folder, "$hexact make cube -o cube.planes").status == 0);
  if (program::run(folder, "$hexact subdivide cube.planes --scheme chamfer --lifts fair -o a.planes").status == 2) {
    WARN("this hexact was built without hexact::fitting");
    return;
  }
  const std::string command = "$hexact subdivide cube.planes --scheme chamfer --levels 3 --json";
  const program::Run fair = program::run(folder, command + " --lifts fair -o fair.planes --certificate fair.cert --threads 1");
  const program::Run automatic = program::run(folder, command + " -o auto.planes");
  REQUIRE(fair.status == 0);
  REQUIRE(automatic.status == 0);
  const auto last = [](const program::Run& run) { return nlohmann::json::parse(run.out)["levels"][3]; };
  CHECK(last(fair)["faces"] == 258);
  CHECK(last(fair)["longest_edge"].get<double>() < 0.7 * last(automatic)["longest_edge"].get<double>());
  CHECK(last(fair)["shortest_edge"].get<double>() > last(automatic)["shortest_edge"].get<double>());
  REQUIRE(program::run(folder, command + " --lifts fair=product -o again.planes --threads 2").status == 0);
  CHECK(program::read_bytes(folder.path().string() + "/fair.planes") == program::read_bytes(folder.path().string() + "/again.planes"));
}

TEST_CASE("fair lifts: objectives that do not exist, behind honeycomb steps, smooth fractions", "[app][fair]") {
  const program::Folder folder;
  REQUIRE(program::run(folder, "$hexact make random 12 1 -o solid.planes").status == 0);
  CHECK(program::run(folder, "$hexact subdivide solid.planes --scheme chamfer --lifts fair=best -o a.planes").status == 2);
  CHECK(program::run(folder, "$hexact subdivide solid.planes --scheme chamfer --lifts fairest -o a.planes").status == 2);
  if (program::run(folder, "$hexact subdivide solid.planes --scheme chamfer --lifts fair -o a.planes").status == 2) return;
  CHECK(program::run(folder, "$hexact subdivide solid.planes --levels 2 --then chamfer:2 --lifts fair=ratio -o a.planes").status == 0);
  CHECK(program::run(folder, "$hexact subdivide solid.planes --scheme chamfer --levels 2 --lifts fair --keep smooth -o a.planes").status == 0);
}

TEST_CASE("reflection lines colour the facets of a mesh", "[app][fair]") {
  const program::Folder folder;
  REQUIRE(program::run(folder, "$hexact make cube -o cube.planes").status == 0);
  REQUIRE(program::run(folder, "$hexact convert cube.planes --to ply-ascii --color reflection -o cube.ply").status == 0);
  const std::string text = program::read_bytes(folder.path().string() + "/cube.ply");
  CHECK(text.find("property uchar red") != std::string::npos);
  CHECK(program::run(folder, "$hexact convert cube.planes --color mirror -o cube.ply").status == 2);
}
