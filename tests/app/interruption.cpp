// SPDX-License-Identifier: GPL-3.0-or-later
// The progress bar, and what Ctrl-C leaves behind.
#include "program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <csignal>
#include <filesystem>
#include <regex>
#include <set>

using namespace hexact;
using program::run;

namespace {

std::set<std::string> listing(const program::Folder& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) names.insert(entry.path().filename().string());
  names.erase(".out");
  names.erase(".err");
  return names;
}

/// The percentages that a bar went through.
std::vector<int> percentages(const std::string& text) {
  std::vector<int> out;
  const std::regex bar(R"(\r\[#* *\] +([0-9]+) %)");
  for (std::sregex_iterator it(text.begin(), text.end(), bar), end; it != end; ++it) out.push_back(std::stoi((*it)[1]));
  return out;
}

}  // namespace

TEST_CASE("--progress draws a bar that only grows, --quiet and pipes show none", "[program][progress]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make cube -o cube.planes").status == 0);
  for (const std::string command : {"subdivide cube.planes --levels 4 -o out.planes --certificate out.cert", "convert out.planes -o out.obj",
                                    "prepare out.planes -o again.planes --triangulate", "certify out.planes -o c.cert", "check out.cert"}) {
    CAPTURE(command);
    const program::Run shown = run(folder, "\"$hexact\" " + command + " --progress");
    REQUIRE(shown.status == 0);
    const auto drawn = percentages(shown.err);
    REQUIRE_FALSE(drawn.empty());
    CHECK(std::is_sorted(drawn.begin(), drawn.end()));
    CHECK(drawn.back() == 100);
    CHECK(shown.out.find('#') == std::string::npos);
    CHECK(percentages(run(folder, "\"$hexact\" " + command + " --progress --quiet").err).empty());
    CHECK(percentages(run(folder, "\"$hexact\" " + command).err).empty());
  }
}

TEST_CASE("SIGINT and SIGTERM end the work with their own status and leave nothing behind", "[program][progress]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make random 29 3 -o r.planes").status == 0);
  const auto before = listing(folder);
  for (const auto& [name, number] : {std::pair{"INT", SIGINT}, {"TERM", SIGTERM}}) {
    // Eight exact levels of a generic solid would take hours.
    const program::Run stopped = run(folder, std::string("timeout -k 20 -s ") + name + " --preserve-status 1 \"$hexact\" subdivide r.planes "
                                     "--arithmetic rational --levels 8 -o out.planes --certificate out.cert --json");
    CAPTURE(stopped.out, stopped.err);
    CHECK(stopped.status == 128 + number);
    CHECK(nlohmann::json::parse(stopped.out).at("error").at("code") == "Cancelled");
    CHECK(listing(folder) == before);
  }
}

TEST_CASE("limits and spectra end at a signal", "[program][progress]") {
  const program::Folder folder;
  // A 128-gon with quadrilaterals on all sides but one: exact elimination over 1014 vertices takes many seconds.
  std::string fan, polygon = "f", sides;
  for (int i = 0; i < 256; ++i) fan += "v " + std::to_string(i % 128) + " " + std::to_string(i * i % 97) + " " + std::to_string(i / 128) + "\n";
  for (int i = 1; i <= 128; ++i) polygon += " " + std::to_string(i);
  for (int i = 1; i < 128; ++i) {
    sides += "f";
    for (const int v : {i + 1, i, 128 + i, 129 + i}) sides += " " + std::to_string(v);
    sides += "\n";
  }
  fan += polygon + "\n" + sides;
  program::write_bytes((folder.path() / "fan.obj").string(), fan);
  const auto before = listing(folder);
  const std::string wait = "timeout -k 60 -s INT --preserve-status 1 \"$hexact\" ";
  for (const std::string command : {"subdivide fan.obj --scheme midedge6 --levels 2 -o x.obj --limit-points x.json", "spectrum --valence 3..600"}) {
    const program::Run stopped = run(folder, wait + command);
    CAPTURE(command, stopped.out, stopped.err);
    CHECK(stopped.status == 128 + SIGINT);
    CHECK(listing(folder) == before);
  }
}

TEST_CASE("an interrupted crosscheck stops its OpenSCAD", "[program][progress]") {
  const program::Folder folder;
  program::write_bytes((folder.path() / "slow").string(), "#!/bin/sh\necho $$ > \"$PIDFILE\"\nexec sleep 600\n");
  REQUIRE(run(folder, "chmod +x slow && \"$hexact\" make cube -o cube.planes").status == 0);
  const program::Run stopped = run(folder, "export PIDFILE=\"$PWD/pid\"; timeout -k 20 -s INT --preserve-status 1 \"$hexact\" crosscheck cube.planes "
                                           "--openscad \"$PWD/slow\"");
  CHECK(stopped.status == 128 + SIGINT);
  CHECK(run(folder, "kill -0 $(cat pid)").status != 0);
}

TEST_CASE("a signal that was ignored stays ignored", "[program][progress]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make cube -o cube.planes").status == 0);
  CHECK(run(folder, "trap '' INT; \"$hexact\" subdivide cube.planes --levels 9 -o out.planes & pid=$!; sleep 0.05; kill -INT $pid; wait $pid").status == 0);
}
