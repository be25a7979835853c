// SPDX-License-Identifier: GPL-3.0-or-later
// subdivide --scheme midedge and midedge6 as a user runs them.
#include "program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

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
