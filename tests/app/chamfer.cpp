// SPDX-License-Identifier: GPL-3.0-or-later
// subdivide --scheme chamfer and --then chamfer:K as a user runs them.
#include "program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <string>

using namespace hexact;
using program::run;
using nlohmann::json;

namespace {

json report_of(const program::Folder& folder, const std::string& command) {
  const program::Run result = run(folder, command + " --json");
  CAPTURE(command, result.out, result.err);
  REQUIRE(result.status == 0);
  return json::parse(result.out);
}

json error_of(const program::Folder& folder, const std::string& command, int status) {
  const program::Run result = run(folder, command + " --json");
  CAPTURE(command, result.out, result.err);
  CHECK(result.status == status);
  return json::parse(result.out).at("error");
}

}  // namespace

TEST_CASE("chamfers of the cube: angles, counts, certificate, correct rounding", "[app][chamfer]") {
  const program::Folder folder;
  REQUIRE(run(folder, "$hexact make cube -o cube.planes").status == 0);
  const json report = report_of(folder, "$hexact subdivide cube.planes --scheme chamfer --levels 4 -o out.obj --certificate out.cert");
  CHECK(report.at("scheme") == "chamfer");
  CHECK(report.at("arithmetic") == "integer");
  CHECK(report.at("min_parameter").is_null());
  const double angles[] = {90, 60, 33.5573, 17.3414, 8.7460};
  std::size_t facets = 6, edges = 12, bits = 0;
  for (std::size_t l = 0; l < 5; ++l) {
    const json& row = report.at("levels").at(l);
    CHECK(row.at("level") == l);
    CHECK(row.at("max_normal_angle_deg").get<double>() == Approx(angles[l]).margin(5e-4));
    CHECK(row.at("faces") == facets);
    CHECK(row.at("edges") == edges);
    CHECK(row.at("vertices") == edges / 3 * 2);
    CHECK(row.at("delta").is_null());
    if (l > 1) CHECK(row.at("plane_bits").get<std::size_t>() <= bits + 1);
    if (l > 0) bits = row.at("plane_bits");
    facets += edges;
    edges *= 4;
  }
  CHECK(run(folder, "$check out.cert out.obj").status == 0);
  CHECK(run(folder, "$hexact check out.cert out.obj").status == 0);
  CHECK(program::read_bytes((folder.path() / "out.cert").string()).find("claim corner-cut-of=input") != std::string::npos);
}

TEST_CASE("chamfer steps behind honeycomb steps", "[app][chamfer]") {
  const program::Folder folder;
  REQUIRE(run(folder, "$hexact make random 12 1 -o r.planes").status == 0);
  for (const std::string arithmetic : {"snapped", "rational"}) {
    const json report = report_of(folder, "$hexact subdivide r.planes --levels 2 --then chamfer:2 --arithmetic " + arithmetic +
                                              " -o out.planes --certificate out.cert --all-levels l%d.planes --limit-points lp.json");
    CHECK(report.at("levels").size() == 5);
    CHECK(report.at("levels").at(4).at("faces") == 12 + 20 + 60 + 270 + 1080);
    CHECK(run(folder, "$check out.cert").status == 0);
    CHECK(run(folder, "cmp out.planes l4.planes").status == 0);
    const std::string planes = program::read_bytes((folder.path() / "out.planes").string());
    CHECK(planes.find(" 4 1079\n") != std::string::npos);  // level and parent edge of the last facet
    const json points = json::parse(program::read_bytes((folder.path() / "lp.json").string()));
    CHECK(points.at("facets").size() == 1442);
  }
  CHECK(report_of(folder, "$hexact subdivide r.planes --levels 1 --then chamfer:0 -o out.planes").at("levels").size() == 2);
}

TEST_CASE("stopping rules and bounds hold for chamfers", "[app][chamfer]") {
  const program::Folder folder;
  REQUIRE(run(folder, "$hexact make cube -o cube.planes").status == 0);
  const std::string start = "$hexact subdivide cube.planes --scheme chamfer -o out.planes ";
  CHECK(report_of(folder, start + "--levels 9 --stop-min-edge 0.1").at("levels").size() == 3);
  CHECK(report_of(folder, start + "--levels 9 --stop-max-panel 1.2").at("levels").size() == 3);
  CHECK(error_of(folder, start + "--levels 9 --max-facets 1048577", 4).at("message").get<std::string>().find("1048578") !=
        std::string::npos);
  CHECK(error_of(folder, start + "--levels 9 --max-memory 100M", 4).at("code") == "ResourceLimit");
  CHECK(error_of(folder, start + "--levels 30", 4).at("code") == "ResourceLimit");
  CHECK(error_of(folder, "$hexact subdivide cube.planes --levels 3 --then chamfer:3 --max-facets 6913 -o out.planes", 4).at("code") ==
        "ResourceLimit");
  CHECK(report_of(folder, "$hexact subdivide cube.planes --levels 3 --then chamfer:3 --max-facets 6914 -o out.planes").at("levels").size() == 7);
}

TEST_CASE("lifts from a file: kept by the certificate, or refused by element", "[app][chamfer]") {
  const program::Folder folder;
  REQUIRE(run(folder, "$hexact make cube -o cube.planes").status == 0);
  const auto write = [&](const std::string& lifts) {
    program::write_bytes((folder.path() / "l.json").string(),
                         R"({"hexact": "lifts", "version": 1, "default": "auto", "levels": [{"level": 0, "lifts": [)" + lifts + "]}]}");
  };
  const std::string command = "$hexact subdivide cube.planes --scheme chamfer --levels 2 --lifts file=l.json -o out.planes --certificate out.cert";
  const std::string eleven = "0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5";
  write(eleven + ", \"1/2\"");
  (void)report_of(folder, command);
  CHECK(run(folder, "$check out.cert").status == 0);
  write(eleven);
  CHECK(error_of(folder, command, 3).at("code") == "BadLifts");
  write(eleven + ", 0");
  CHECK(error_of(folder, command, 3).at("code") == "LiftNotPositive");
  CHECK(error_of(folder, command, 3).at("element").get<std::string>().starts_with("edge "));
  write(eleven + ", 1");
  CHECK(error_of(folder, command, 3).at("code") == "TriangleInequality");
  CHECK(error_of(folder, command, 3).at("element").get<std::string>().starts_with("vertex "));
  write("1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1");
  CHECK(error_of(folder, command, 3).at("code") == "SideCollapse");
  program::write_bytes((folder.path() / "l.json").string(), "{");
  CHECK(error_of(folder, command, 3).at("file") == "l.json");
}

TEST_CASE("chamfer options that do not exist, and inputs that cannot be chamfered", "[app][chamfer]") {
  const program::Folder folder;
  REQUIRE(run(folder, "$hexact make cube -o cube.planes").status == 0);
  for (const std::string bad : {"--then chamfer", "--then chamfer:x", "--then chamfer:-1", "--then phs:2", "--lifts auto", "--keep 0.5",
                                "--then chamfer:1 --keep 0", "--then chamfer:1 --keep 1", "--then chamfer:1 --keep x",
                                "--then chamfer:1 --lifts best", "--then chamfer:1 --arithmetic double",
                                "--then chamfer:1 --arithmetic qsqrt5", "--scheme chamfer --then chamfer:1",
                                "--scheme chamfer --parameters static", "--scheme chamfer --arithmetic snapped"}) {
    CAPTURE(bad);
    CHECK(run(folder, "$hexact subdivide cube.planes -o out.obj " + bad).status == 2);
  }
  CHECK(run(folder, "$hexact subdivide cube.planes -o out.obj --scheme chamfer --keep smooth").status == 0);
  CHECK(run(folder, "$hexact subdivide cube.planes -o out.obj --scheme chamfer --keep 1/3 --levels 3").status == 0);
  REQUIRE(run(folder, "$hexact make dodecahedron -o d.planes && $hexact make octahedron -o o.planes").status == 0);
  CHECK(error_of(folder, "$hexact subdivide d.planes --scheme chamfer -o out.obj", 3).at("code") == "FieldNotRational");
  CHECK(error_of(folder, "$hexact subdivide o.planes --scheme chamfer -o out.obj", 3).at("code") == "NotTrivalent");
  program::write_bytes((folder.path() / "bent.off").string(),
                       "OFF\n8 6 0\n-1 -1 -1\n1 -1 -1\n1 1 -1\n-1 1 -1\n-1 -1 1\n1 -1 1\n1 1 1.25\n-1 1 1\n"
                       "4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
  CHECK(error_of(folder, "$hexact subdivide bent.off --scheme chamfer -o out.obj", 3).at("element") == "facet 1");
}
