// SPDX-License-Identifier: GPL-3.0-or-later
// subdivide --scheme midedge and midedge6 as a user runs them.
#include "program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cmath>
#include <sstream>

using namespace hexact;
using program::run;

namespace {

const char* const kCube =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
const char* const kStrip = "v 0 0 0\nv 1 0 0\nv 2 0 1\nv 0 1 0\nv 1 1 0\nv 2 1 1\nf 1 2 5 4\nf 2 3 6 5\n";

nlohmann::json report(const program::Run& result) {
  CAPTURE(result.err);
  REQUIRE(result.status == 0);
  return nlohmann::json::parse(result.out);
}

}  // namespace

TEST_CASE("the cube to seven steps by both rules, in both arithmetics", "[app][midedge]") {
  const program::Folder folder;
  program::write_bytes((folder.path() / "cube.obj").string(), kCube);
  const double six_point[] = {8, 625.0 / 384, 0.7421, 0.5159, 0.4315, 0.3948, 0.3777, 0.3695};
  const double simple[] = {8, 20.0 / 3, 5.667, 5.292, 5.120, 5.038, 4.997, 4.977};
  for (const std::string scheme : {"midedge", "midedge6"}) {
    for (const std::string arithmetic : {"double", "rational"}) {
      const auto r = report(run(folder, "$hexact subdivide cube.obj --scheme " + scheme + " --arithmetic " + arithmetic +
                                            " --levels 7 -o " + scheme + arithmetic + ".obj --json"));
      CHECK(r.at("scheme") == scheme);
      CHECK(r.at("arithmetic") == arithmetic);
      CHECK(r.at("max_rounding") == 0);
      REQUIRE(r.at("levels").size() == 8);
      for (std::size_t n = 0; n < 8; ++n) {
        const auto& row = r.at("levels")[n];
        CHECK(row.at("vertices") == (n == 0 ? 8 : 12 << (n - 1)));
        CHECK(row.at("edges") == 12 << n);
        CHECK(row.at("faces") == (n == 0 ? 6 : (12 << (n - 1)) + 2));
        CHECK(row.at("volume").get<double>() == Approx(scheme == "midedge" ? simple[n] : six_point[n]).epsilon(2e-4));
        for (const char* key : {"seconds", "max_normal_angle_deg", "median_normal_angle_deg", "longest_edge", "shortest_edge",
                                "max_facet_diameter", "delta"}) {
          CHECK(row.contains(key));
        }
      }
    }
    // All coordinates of these levels are doubles, so both arithmetics write the same bytes.
    CHECK(program::read_bytes((folder.path() / (scheme + "double.obj")).string()) ==
          program::read_bytes((folder.path() / (scheme + "rational.obj")).string()));
  }
  CHECK(report(run(folder, "$hexact subdivide cube.obj --scheme midedge6 -o a.obj --json")).at("arithmetic") == "double");
}

TEST_CASE("open meshes: dual makes double steps, close and drop single ones", "[app][midedge]") {
  const program::Folder folder;
  program::write_bytes((folder.path() / "strip.obj").string(), kStrip);
  auto r = report(run(folder, "$hexact subdivide strip.obj --scheme midedge6 --levels 4 -o a.obj --all-levels l%d.off --json"));
  REQUIRE(r.at("levels").size() == 3);
  CHECK(r.at("boundary") == "dual");
  CHECK(r.at("levels")[1].at("level") == 2);
  CHECK(r.at("levels")[1].at("faces") == 3);
  CHECK(program::read_bytes((folder.path() / "l2.off").string()).starts_with("OFF\n8 3 0\n"));
  CHECK(program::read_bytes((folder.path() / "l1.off").string()).empty());
  r = report(run(folder, "$hexact subdivide strip.obj --scheme midedge6 --boundary close --levels 3 -o a.obj --json"));
  CHECK(r.at("levels").size() == 4);
  CHECK(r.at("levels")[3].at("pinched_vertices") == 0);
  const auto pinched = run(folder, "$hexact make saddle -o saddle.obj --quiet && "
                                   "$hexact subdivide saddle.obj --scheme midedge --boundary drop --levels 3 -o a.obj --json");
  CHECK(nlohmann::json::parse(pinched.out.substr(pinched.out.rfind("{\"scheme"))).at("levels")[3].at("pinched_vertices") == 8);
  CHECK(pinched.err.find("no manifold") != std::string::npos);
}

TEST_CASE("what Midedge cannot do is refused with the right status and the element", "[app][midedge]") {
  const program::Folder folder;
  const auto file = [&](const char* name, const std::string& bytes) { program::write_bytes((folder.path() / name).string(), bytes); };
  file("cube.obj", kCube);
  file("strip.obj", kStrip);
  file("isolated.obj", std::string(kCube) + "v 7 7 7\n");
  file("fin.obj", std::string(kCube) + "v 7 7 7\nf 1 2 9\n");
  file("pillow.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n");
  file("bowtie.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -1 0 0\nv 0 -1 0\nf 1 2 3\nf 1 4 5\n");
  const auto expect = [&](const std::string& arguments, int status, const std::string& place) {
    const auto result = run(folder, "$hexact subdivide " + arguments + " -o out.obj --json");
    CAPTURE(arguments, result.out, result.err);
    CHECK(result.status == status);
    CHECK(result.out.find("\"error\"") != std::string::npos);
    CHECK(result.out.find(place) != std::string::npos);
    CHECK(program::read_bytes((folder.path() / "out.obj").string()).empty());
  };
  expect("strip.obj --scheme midedge6 --levels 3", 2, "odd");
  expect("strip.obj --scheme midedge --levels 1", 2, "odd");
  expect("isolated.obj --scheme midedge6 --levels 2", 3, "vertex 8");
  expect("fin.obj --scheme midedge6 --levels 2", 3, "edge 0-1");
  expect("pillow.obj --scheme midedge --levels 2", 3, "vertex 0");
  expect("bowtie.obj --scheme midedge --levels 2", 3, "vertex 0");
  expect("cube.obj --scheme midedge6 --arithmetic snapped", 2, "snapped");
  expect("cube.obj --scheme midedge6 --certificate c.cert", 2, "--certificate");
  expect("cube.obj --scheme midedge6 --parameters static", 2, "--parameters");
  expect("cube.obj --scheme phs --boundary close", 2, "--boundary");
  expect("cube.obj --scheme midedge6 --levels 20 --max-facets 1000", 4, "6291458");
  expect("cube.obj --scheme midedge6 --levels 20 --max-memory 1MiB", 4, "--max-memory");
  expect("cube.obj --scheme midedge6 --levels 60", 4, "half-edges");
}

TEST_CASE("--keep-size keeps the volume on every level", "[app][midedge]") {
  const program::Folder folder;
  program::write_bytes((folder.path() / "cube.obj").string(), kCube);
  for (const std::string options : {"--scheme midedge6", "--scheme midedge", "--scheme midedge6 --arithmetic rational"}) {
    const auto r = report(run(folder, "$hexact subdivide cube.obj --keep-size --levels 7 -o a.off --json " + options));
    for (const auto& row : r.at("levels")) CHECK(row.at("volume").get<double>() == Approx(8).epsilon(1e-12));
    REQUIRE(r.at("size_factors").size() == 1);
    CHECK(report(run(folder, "$hexact info a.off --json")).at("vertices") == 768);
  }
}

TEST_CASE("limit points, planes and bounds of the cube's facets, and its mesh on the limit surface", "[app][midedge]") {
  const program::Folder folder;
  program::write_bytes((folder.path() / "cube.obj").string(), kCube);
  (void)report(run(folder, "$hexact subdivide cube.obj --scheme midedge6 --levels 1 --limit-points l.json -o a.obj --json"));
  const auto document = nlohmann::json::parse(program::read_bytes((folder.path() / "l.json").string()));
  CHECK(document.at("hexact") == "limit-points");
  REQUIRE(document.at("facets").size() == 14);
  const auto& top = document.at("facets")[1];  // f 5 6 7 8
  CHECK(top.at("facet") == 1);
  CHECK(top.at("plane")[2] == 1);
  CHECK(top.at("plane")[3] == top.at("point")[2]);
  CHECK(top.at("exact")[0] == "0");
  CHECK(top.at("exact_normal")[0] == "0");
  CHECK(top.at("normal_bound").get<double>() < 1e-14);
  const auto& corner = document.at("facets")[12];  // vertex 7
  CHECK(corner.at("point")[0] == corner.at("point")[2]);
  CHECK(corner.at("plane")[1].get<double>() == Approx(1 / std::sqrt(3.0)).epsilon(1e-13));
  CHECK_FALSE(corner.contains("exact_normal"));
  // The vertex of level 0 becomes the facet of level 1: --limit puts it where that facet's limit is.
  (void)report(run(folder, "$hexact subdivide cube.obj --scheme midedge6 --levels 0 --limit -o on.obj --json"));
  std::istringstream lines(program::read_bytes((folder.path() / "on.obj").string()));
  std::string word;
  for (std::size_t v = 0; v < 8; ++v) {
    lines >> word;
    REQUIRE(word == "v");
    for (std::size_t c = 0; c < 3; ++c) {
      lines >> word;
      CHECK(std::stod(word) == document.at("facets")[6 + v].at("point")[c].get<double>());
    }
  }
  CHECK(run(folder, "$hexact subdivide cube.obj --scheme midedge6 --levels 1 --limit-points l.json -o a.obj --max-facets 20").status == 4);
}

TEST_CASE("texture coordinates, groups, materials and addresses go through the program", "[app][midedge]") {
  const program::Folder folder;
  std::string cube = std::string("mtllib a.mtl\n") + kCube;
  const std::size_t facets = cube.find("f 4");
  cube = cube.substr(0, facets) + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl brick\ng floor\nf 4/1 3/2 2/3 1/4\ng walls\n" +
         cube.substr(cube.find("f 5"));
  program::write_bytes((folder.path() / "cube.obj").string(), cube);
  (void)report(run(folder, "$hexact subdivide cube.obj --scheme midedge6 --levels 2 -o a.obj --json"));
  const std::string text = program::read_bytes((folder.path() / "a.obj").string());
  CHECK(text.starts_with("mtllib a.mtl\n"));
  // In the corner (0, 0): 5/16 of the middles (1/2, 0) and (0, 1/2), 3/32 of (1, 1/2) and (1/2, 1), 3/16 of the corner.
  CHECK(text.find("\nvt 0.296875 0.296875\n") != std::string::npos);
  CHECK(text.find("\ng floor f0_-\n") != std::string::npos);
  CHECK(text.find("\ng walls f2_11\n") != std::string::npos);
  CHECK(text.find("\nusemtl brick\n") != std::string::npos);
  // Read back, refined again, addresses count on.
  (void)report(run(folder, "$hexact subdivide a.obj --scheme midedge --levels 1 -o b.obj --json"));
  const std::string again = program::read_bytes((folder.path() / "b.obj").string());
  CHECK(again.find("g walls f2_11\n") != std::string::npos);
  CHECK(again.find(" f3_0\n") != std::string::npos);
  CHECK(report(run(folder, "$hexact convert a.obj -o c.ply --json")).at("faces") == 26);
  CHECK(program::read_bytes((folder.path() / "c.ply").string()).find("double texcoord") != std::string::npos);
}
