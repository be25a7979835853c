// SPDX-License-Identifier: GPL-3.0-or-later
// crosscheck through the program, with OpenSCAD, without it and with one that hangs or lies.
#include "program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

using namespace hexact;
using program::run;

namespace {

nlohmann::json object(const program::Run& result) {
  CAPTURE(result.out, result.err);
  return nlohmann::json::parse(result.out);
}

}  // namespace

TEST_CASE("crosscheck: OpenSCAD agrees by all routes", "[program][crosscheck]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make cube -o c.planes && \"$hexact\" subdivide c.planes --levels 1 -o s.planes").status == 0);
  const program::Run result = run(folder, "\"$hexact\" crosscheck s.planes --route all --json");
  const auto report = object(result);
  CHECK(result.status == 0);
  CHECK(report.at("verdict") == "agree");
  const nlohmann::json counts = {{"vertices", 24}, {"edges", 36}, {"facets", 14}};
  CHECK(report.at("ours") == counts);
  CHECK(report.at("openscad") == counts);
  CHECK(report.at("volume_difference").get<double>() <= report.at("bound").get<double>());
  CHECK(report.at("reason") == "");
  CHECK(report.at("routes").size() == 3);
}

TEST_CASE("crosscheck without a working OpenSCAD is not checked: exit 5 with the reason", "[program][crosscheck]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make cube -o c.planes && \"$hexact\" make dodecahedron -o d.planes").status == 0);
  const auto unchecked = [&](const std::string& command, const std::string& reason) {
    const program::Run result = run(folder, command);
    CAPTURE(command, result.out, result.err);
    CHECK(result.status == 5);
    const auto report = object(result);
    CHECK(report.at("verdict") == "not-checked");
    CHECK(report.at("reason").get<std::string>().find(reason) != std::string::npos);
    CHECK(report.at("openscad").is_null());
    CHECK(report.at("ours").at("vertices").get<int>() > 0);
  };
  unchecked("mkdir -p empty; PATH=\"$PWD/empty\" \"$hexact\" crosscheck c.planes --json", "is OpenSCAD installed");
  unchecked("\"$hexact\" crosscheck c.planes --json --openscad /bin/false", "exit status 1");
  program::write_bytes((folder.path() / "hangs").string(), "#!/bin/sh\nexec sleep 600\n");
  program::write_bytes((folder.path() / "silent").string(), "#!/bin/sh\nexit 0\n");
  unchecked("chmod +x hangs silent; \"$hexact\" crosscheck c.planes --json --time-limit 0.3 --openscad \"$PWD/hangs\"", "time limit");
  unchecked("\"$hexact\" crosscheck c.planes --json --openscad \"$PWD/silent\"", "no counts");
  unchecked("\"$hexact\" crosscheck c.planes --json --max-cuts 5", "more than the bound");
  unchecked("\"$hexact\" crosscheck d.planes --json", "sqrt5");
}

TEST_CASE("crosscheck with an OpenSCAD that counts otherwise differs: exit 1", "[program][crosscheck]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make cube -o c.planes && \"$hexact\" make tetrahedron -o t.planes").status == 0);
  // It is given one program and builds another.
  REQUIRE(run(folder, "\"$hexact\" crosscheck t.planes --keep other.scad").status == 0);
  program::write_bytes((folder.path() / "wrong").string(), "#!/bin/sh\nexec openscad -o \"$2\" \"$OTHER\"\n");
  const program::Run result = run(folder, "chmod +x wrong; export OTHER=\"$PWD/other.scad\"; \"$hexact\" crosscheck c.planes --json --openscad \"$PWD/wrong\"");
  CHECK(result.status == 1);
  const auto report = object(result);
  CHECK(report.at("verdict") == "differ");
  CHECK_FALSE(report.at("reason").get<std::string>().empty());
}
