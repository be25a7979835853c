// SPDX-License-Identifier: GPL-3.0-or-later
// Where subdivide writes, what it refuses before it writes, and numbers at the end of the doubles.
#include "program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <set>
#include <sstream>

using namespace hexact;
using program::run;

namespace {

/// The cube ±size, every facet with the four texture coordinates if there are some.
std::string cube(const std::string& size, const std::string& texture = "") {
  std::string text;
  for (int v = 0; v < 8; ++v) {
    for (int c = 0; c < 3; ++c) text += (c == 0 ? "v " : " ") + std::string((v >> c) % 2 == 0 ? "-" : "") + size;
    text += "\n";
  }
  text += texture;
  for (const char* f : {"1 3 4 2", "5 6 8 7", "1 2 6 5", "3 7 8 4", "1 5 7 3", "2 4 8 6"}) {
    std::istringstream corners(f);
    text += "f";
    int t = 0;
    for (std::string v; corners >> v;) text += " " + v + (texture.empty() ? "" : "/" + std::to_string(++t));
    text += "\n";
  }
  return text;
}

std::string grid(int m) {
  std::string text;
  for (int i = 0; i <= m * (m + 2); ++i) text += "v " + std::to_string(i % (m + 1)) + " " + std::to_string(i / (m + 1)) + " 0\n";
  for (int i = 0; i < m * m; ++i) {
    const int a = i / m * (m + 1) + i % m + 1;
    text += "f";
    for (const int v : {a, a + 1, a + m + 2, a + m + 1}) text += " " + std::to_string(v);
    text += "\n";
  }
  return text;
}

struct Place : program::Folder {
  void file(const char* name, const std::string& bytes) const { program::write_bytes((path() / name).string(), bytes); }
  [[nodiscard]] std::string bytes(const std::string& name) const { return program::read_bytes((path() / name).string()); }
  [[nodiscard]] std::set<std::string> files() const {
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path())) names.insert(entry.path().filename().string());
    names.erase(".out");
    names.erase(".err");
    return names;
  }
  /// Expects that the command ends with the status, names the reason and writes nothing.
  void refused(const std::string& arguments, int status, const std::string& reason) const {
    const auto before = files();
    const auto result = run(*this, "$hexact subdivide " + arguments);
    CAPTURE(arguments, result.out, result.err);
    CHECK(result.status == status);
    CHECK((result.out + result.err).find(reason) != std::string::npos);
    CHECK(files() == before);
  }
};

}  // namespace

TEST_CASE("Midedge in doubles ends where it leaves them", "[app][midedge]") {
  const Place folder;
  folder.file("big.obj", cube("1e308"));
  folder.file("half.obj", cube("1e307"));
  folder.file("vt.obj", cube("1", "vt 1.7e308 1.7e308\nvt -1.7e308 1.7e308\nvt -1.7e308 -1.7e308\nvt 1.7e308 -1.7e308\n"));
  for (const std::string limits : {"", " --limit-points x.json", " --limit"}) {
    folder.refused("big.obj --scheme midedge6 --levels 2 -o x.obj" + limits, 4, "a coordinate is beyond the finite doubles");
  }
  for (const std::string scheme : {"midedge", "midedge6"}) {
    folder.refused("vt.obj --levels 2 -o x.obj --scheme " + scheme, 4, "a texture coordinate is beyond the finite doubles");
  }
  CHECK(run(folder, "$hexact subdivide half.obj --scheme midedge6 --levels 2 -o x.obj --limit-points x.json").status == 0);
  CHECK(folder.bytes("x.obj").find("inf") == std::string::npos);
  CHECK(run(folder, "$hexact subdivide big.obj --scheme midedge6 --arithmetic rational --levels 2 -o x.obj --limit").status == 0);
}

TEST_CASE("a limit plane whose offset is no double is refused", "[app][midedge]") {
  const Place folder;
  // An octahedron of radius 1e307 about (1.6e308, 1.6e308, 1.6e308): its offsets are √3 times as large.
  std::string text;
  for (const char* v : {"1.7e308 1.6e308 1.6e308", "1.5e308 1.6e308 1.6e308", "1.6e308 1.7e308 1.6e308", "1.6e308 1.5e308 1.6e308",
                        "1.6e308 1.6e308 1.7e308", "1.6e308 1.6e308 1.5e308"}) {
    text += std::string("v ") + v + "\n";
  }
  folder.file("far.obj", text + "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n");
  folder.refused("far.obj --scheme midedge6 --arithmetic rational --levels 0 -o o.obj --limit-points x.json", 4, "offset of a plane");
}

TEST_CASE("one place takes one result", "[app][midedge]") {
  const Place folder;
  folder.file("cube.obj", cube("1"));
  REQUIRE(run(folder, "$hexact convert cube.obj -o c.planes").status == 0);
  for (const std::string input : {"cube.obj --scheme midedge6 ", "c.planes --scheme phs "}) {
    folder.refused(input + "-o a.obj --limit-points - --json", 2, "both need standard output");
    folder.refused(input + "-o - --to obj --limit-points -", 2, "both need standard output");
    folder.refused(input + "-o - --to obj --json", 2, "both need standard output");
    folder.refused(input + "-o same.obj --limit-points ./same.obj", 2, "--limit-points both name");
    folder.refused(input + "--levels 2 --all-levels l%d.obj -o l2.obj", 2, "--all-levels and -o both name l2.obj");
    folder.refused(input + "--levels 2 --all-levels l%d.obj -o a.obj --limit-points l1.obj", 2, "--all-levels and --limit-points");
    const auto document = run(folder, "$hexact subdivide " + input + "-o a.obj --limit-points -");
    CHECK(document.status == 0);
    CHECK(nlohmann::json::parse(document.out).at("hexact") == "limit-points");
    CHECK(run(folder, "$hexact subdivide " + input + "--levels 2 --all-levels l%d.obj -o l3.obj").status == 0);
  }
  folder.refused("c.planes -o a.planes --certificate a.planes", 2, "--certificate both name");
  folder.refused("c.planes --levels 1 --then chamfer:1 --all-levels m%d.obj -o m2.obj", 2, "--all-levels and -o");
  folder.refused("cube.obj --scheme midedge --all-levels m%d.obj -o m0.obj", 2, "--all-levels and -o");
  CHECK(run(folder, "$hexact subdivide c.planes --all-levels m%d.obj -o m0.obj").status == 0);
}

TEST_CASE("levels have the format of their own names", "[app][midedge]") {
  const Place folder;
  folder.file("cube.obj", cube("1"));
  REQUIRE(run(folder, "$hexact convert cube.obj -o c.planes").status == 0);
  for (const std::string input : {"cube.obj --scheme midedge6 ", "c.planes --scheme phs ", "c.planes --scheme chamfer "}) {
    CAPTURE(input);
    REQUIRE(run(folder, "$hexact subdivide " + input + "-o - --to ply --all-levels z%d.off").status == 0);
    CHECK(folder.bytes("z1.off").starts_with("OFF\n"));
    REQUIRE(run(folder, "$hexact subdivide " + input + "-o - --to ply-ascii --all-levels z%d.ply").status == 0);
    CHECK(folder.bytes("z1.ply").starts_with("ply\nformat ascii"));
    REQUIRE(run(folder, "$hexact subdivide " + input + "-o - --to off --all-levels z%d").status == 0);
    CHECK(folder.bytes("z1").starts_with("OFF\n"));
    folder.refused(input + "-o a.obj --all-levels y%d", 2, "--to");
  }
}

TEST_CASE("limit points bear the addresses of the mesh", "[app][midedge]") {
  const Place folder;
  folder.file("cube.obj", cube("1"));
  REQUIRE(run(folder, "$hexact subdivide cube.obj --scheme midedge --levels 1 -o a.ply").status == 0);
  REQUIRE(run(folder, "$hexact subdivide a.ply --scheme midedge --levels 1 -o b.obj --limit-points b.json").status == 0);
  std::string groups, expected;
  std::istringstream lines(folder.bytes("b.obj"));
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("g ")) groups += line + "\n";
  }
  const auto document = nlohmann::json::parse(folder.bytes("b.json"));
  for (const auto& f : document.at("facets")) {
    const auto& parent = f.at("parent");
    expected += "g f" + f.at("level").dump() + "_" + (parent.is_null() ? "-" : parent.dump()) + "\n";
  }
  CHECK(groups.find("g f2_0\n") != std::string::npos);
  CHECK(groups.find("g f1_7\n") != std::string::npos);
  CHECK(groups == expected);
}

TEST_CASE("what limits need is known before anything is written", "[app][midedge]") {
  const Place folder;
  folder.file("cube.obj", cube("1"));
  folder.file("grid.obj", grid(60));
  folder.refused("cube.obj --scheme midedge6 --levels 3 --max-facets 50 --limit-points p.json --all-levels l%d.obj -o a.obj", 4, "194 facets");
  folder.refused("cube.obj --scheme midedge --levels 3 --max-facets 97 --limit --all-levels l%d.obj -o a.obj", 4, "98 facets");
  folder.refused("grid.obj --scheme midedge6 --levels 0 --max-memory 4mb --limit-points p.json -o a.obj", 4, "with its limits");
  folder.refused("grid.obj --scheme midedge6 --levels 0 --max-memory 2mb --limit -o a.obj", 4, "with its limits");
  folder.refused("grid.obj --scheme midedge --boundary drop --limit --levels 2 --all-levels l%d.obj -o a.obj", 3, "dual or close");
  folder.file("vt.obj", cube("1", "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"));
  folder.refused("vt.obj --scheme midedge6 --levels 16 --max-memory 130mb -o a.obj", 4, "--max-memory");
  CHECK(run(folder, "$hexact subdivide cube.obj --scheme midedge6 --levels 3 --max-facets 50 -o a.obj").status == 0);
  CHECK(run(folder, "$hexact subdivide cube.obj --scheme midedge --levels 3 --max-facets 98 --limit -o a.obj").status == 0);
  CHECK(run(folder, "$hexact subdivide grid.obj --scheme midedge6 --levels 0 --max-memory 4mb -o a.obj").status == 0);
}

TEST_CASE("a report says that the vertices moved to their limits", "[app][midedge]") {
  const Place folder;
  folder.file("cube.obj", cube("1"));
  const std::string command = "$hexact subdivide cube.obj --scheme midedge6 --levels 2 --keep-size -o a.obj";
  CHECK(nlohmann::json::parse(run(folder, command + " --limit --json").out).at("limit") == true);
  CHECK_FALSE(nlohmann::json::parse(run(folder, command + " --json").out).contains("limit"));
  CHECK(run(folder, command + " --limit").out.find("before they moved") != std::string::npos);
  CHECK(run(folder, command).out.find("before they moved") == std::string::npos);
}
