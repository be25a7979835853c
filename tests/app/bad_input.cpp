// SPDX-License-Identifier: GPL-3.0-or-later
// What the program does with files that are wrong and outputs that cannot be written: exit status, the place named in
// the message, and nothing left behind.
#include "program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <filesystem>
#include <set>
#include <string>
#include <vector>

using namespace hexact;
using program::run;

namespace {

const char* const kCube =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n"
    "f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

struct Bad {
  std::string name;   ///< file name
  std::string bytes;
  std::string place;  ///< part of the message or element that names the place; may be empty
};

std::set<std::string> listing(const program::Folder& folder) {
  std::set<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder.path())) names.insert(entry.path().filename().string());
  names.erase(".out");
  names.erase(".err");
  return names;
}

void expect_rejected(const program::Folder& folder, const std::string& command, int status, const std::string& place) {
  const std::set<std::string> before = listing(folder);
  const program::Run result = run(folder, command + " --json");
  CAPTURE(command, result.out, result.err);
  CHECK(result.status == status);
  CHECK(listing(folder) == before);
  const auto error = nlohmann::json::parse(result.out).at("error");
  for (const char* key : {"code", "message", "file", "line", "element"}) CHECK(error.contains(key));
  CHECK_FALSE(error.at("message").get<std::string>().empty());
  CHECK((result.out + result.err).find(place) != std::string::npos);
}

/// Files that no subcommand can read.
std::vector<Bad> unreadable() {
  const std::string cube = kCube;
  return {
      {"nan.obj", replaced(cube, "v 1 -1 -1", "v 1 nan -1"), "nan.obj:2"},
      {"inf.obj", replaced(cube, "v 1 -1 -1", "v 1 -inf -1"), "inf.obj:2"},
      {"huge.obj", replaced(cube, "v 1 -1 -1", "v 1 1e999999999 -1"), "huge.obj:2"},
      {"over.obj", replaced(cube, "v 1 -1 -1", "v 1 1e309 -1"), "over.obj:2"},
      {"word.obj", replaced(cube, "v 1 -1 -1", "v 1 one -1"), "word.obj:2"},
      {"index.obj", replaced(cube, "f 4 3 2 1", "f 4 3 2 9"), "index.obj:9"},
      {"zero.obj", replaced(cube, "f 4 3 2 1", "f 4 3 2 0"), "zero.obj:9"},
      {"negative.obj", replaced(cube, "f 4 3 2 1", "f 4 3 2 -9"), "negative.obj:9"},
      {"two.obj", replaced(cube, "f 4 3 2 1", "f 4 3"), "two.obj:9"},
      {"short.obj", replaced(cube, "v 1 -1 -1", "v 1 -1"), "short.obj:2"},
      {"empty.obj", "", "empty.obj"},
      {"empty.off", "", "empty.off"},
      {"empty.ply", "", "empty.ply"},
      {"empty.stl", "", "empty.stl"},
      {"empty.planes", "", "empty.planes"},
      {"garbage.off", std::string("\x7f" "ELF\x02\x01\x01\0\0\0\xff\xfe\x01", 14), "garbage.off"},
      {"garbage.planes", std::string("\0\1\2\3\4", 5), "garbage.planes"},
      {"cut.off", "OFF\n4 4 6\n0 0 0\n1 0 0\n0 1 0\n", "cut.off"},
      {"nan.off", "OFF\n3 1 3\n0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n", "nan.off:4"},
      {"index.off", "OFF\n3 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "index.off:6"},
      {"many.off", "OFF\n4000000000 4000000000 0\n0 0 0\n", "many.off"},
      {"cut.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n", "cut.ply"},
      {"cut_binary.ply",
       "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
       "element face 1\nproperty list uchar int vertex_indices\nend_header\nabcd", "cut_binary.ply"},
      {"cut.stl", "solid x\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n", "cut.stl"},
      {"cut_binary.stl", std::string(80, ' ') + std::string("\x02\0\0\0", 4) + std::string(60, '\0'), "cut_binary.stl"},
      {"version.planes", "hexact-planes 2\nfield Q\n", "version.planes:1"},
      {"cut.planes", "hexact-planes 1\nfield Q\nscale 0\nplanes 4\n1 0 0 1 0 -\n", "cut.planes"},
      {"zero.planes", "hexact-planes 1\nfield Q\nscale 0\nplanes 1\n0 0 0 1 0 -\nloops 1\n0\n", "zero.planes:5"},
  };
}

/// Files that can be read and are no closed convex solid.
std::vector<Bad> no_solids() {
  const std::string cube = kCube;
  const std::string tetrahedron = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
  return {
      {"open.obj", replaced(cube, "f 4 1 5 8\n", ""), "edge"},
      {"three_facets.obj", cube + "f 1 2 3\n", "edge"},
      {"turned.obj", replaced(cube, "f 4 1 5 8", "f 8 5 1 4"), "edge"},
      {"repeated_corner.obj", replaced(cube, "f 4 3 2 1", "f 4 3 3 2 1"), "facet 0"},
      {"two_parts.obj", tetrahedron + "v 5 0 0\nv 6 0 0\nv 5 1 0\nv 5 0 1\nf 5 7 6\nf 5 6 8\nf 6 7 8\nf 7 5 8\n", ""},
      {"pinched.obj",  // two tetrahedra that share one vertex
       tetrahedron + "v -1 0 0\nv 0 -1 0\nv 0 0 -1\nf 1 6 5\nf 1 5 7\nf 5 6 7\nf 6 1 7\n", "vertex 0"},
      {"dented.obj", replaced(cube, "v 1 1 1\n", "v 0.5 0.5 0.5\n"), ""},
      {"flat.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 3 2\n", ""},
      {"inside_out.obj",
       "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nf 2 4 3\nf 3 4 1\n", ""},
  };
}

}  // namespace

TEST_CASE("files that cannot be read: exit 3, the place named, nothing written", "[program]") {
  const program::Folder folder;
  for (const Bad& bad : unreadable()) {
    program::write_bytes((folder.path() / bad.name).string(), bad.bytes);
    for (const std::string command : {"info ", "prepare -o out.planes ", "convert -o out.off ", "subdivide -o out.planes ", "certify -o out.cert "}) {
      expect_rejected(folder, "\"$hexact\" " + command + bad.name, 3, bad.place);
    }
  }
  expect_rejected(folder, "\"$hexact\" prepare -o out.planes nothing.obj", 3, "nothing.obj");
  expect_rejected(folder, "\"$hexact\" prepare -o out.planes .", 3, "directory");
  expect_rejected(folder, "printf 'v 1 2 x\\n' | \"$hexact\" prepare -o out.planes --from obj -", 3, "1");
}

TEST_CASE("files without a convex solid: exit 3 from prepare and subdivide", "[program]") {
  const program::Folder folder;
  for (const Bad& bad : no_solids()) {
    program::write_bytes((folder.path() / bad.name).string(), bad.bytes);
    for (const std::string command : {"prepare -o out.planes ", "subdivide -o out.planes "}) {
      expect_rejected(folder, "\"$hexact\" " + command + bad.name, 3, bad.place);
    }
  }
  // Collinear corners are dropped by prepare, exactly, and named by subdivide.
  program::write_bytes((folder.path() / "collinear.obj").string(),
                       replaced(replaced(kCube, "v -1 1 1\n", "v -1 1 1\nv 0 -1 -1\n"), "f 4 3 2 1", "f 4 3 2 9 1"));
  expect_rejected(folder, "\"$hexact\" subdivide -o out.planes collinear.obj", 3, "");
}

TEST_CASE("1e308 is a legal coordinate: exact, or exit 4, never inf or nan", "[program]") {
  const program::Folder folder;
  std::string text = kCube;
  for (std::size_t at = 0; (at = text.find('1', at)) != std::string::npos && at < text.find('f'); at += 5) text.insert(at + 1, "e308");
  program::write_bytes((folder.path() / "big.obj").string(), text);
  const program::Run info = run(folder, "\"$hexact\" info big.obj --json --exact");
  CAPTURE(info.out, info.err);
  CHECK((info.status == 0 || info.status == 4));
  CHECK(info.out.find("inf") == std::string::npos);
  CHECK(info.out.find("nan") == std::string::npos);
  const program::Run made = run(folder, "\"$hexact\" subdivide big.obj --levels 2 -o big.planes && \"$hexact\" convert big.planes -o big2.obj");
  CHECK((made.status == 0 || made.status == 4));
  if (made.status == 0) CHECK(program::read_bytes((folder.path() / "big2.obj").string()).find("inf") == std::string::npos);
}

TEST_CASE("outputs that cannot be written: exit 3 and nothing left behind", "[program]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make cube -o cube.planes").status == 0);
  program::write_bytes((folder.path() / "file").string(), "x");
  expect_rejected(folder, "\"$hexact\" subdivide cube.planes -o file/out.planes", 3, "file/out.planes");
  expect_rejected(folder, "\"$hexact\" subdivide cube.planes -o nowhere/out.planes", 3, "nowhere/out.planes");
  expect_rejected(folder, "\"$hexact\" subdivide cube.planes --to planes -o .", 3, "");
  expect_rejected(folder, "\"$hexact\" subdivide cube.planes --to planes -o /dev/full", 3, "/dev/full");
  expect_rejected(folder, "ulimit -f 8; \"$hexact\" subdivide cube.planes --levels 6 -o out.planes", 3, "out.planes");
  CHECK(run(folder, "\"$hexact\" subdivide cube.planes --to planes -o - > /dev/full").status == 3);
  // What stood there stays when the new file cannot be written whole.
  program::write_bytes((folder.path() / "old.planes").string(), "precious");
  CHECK(run(folder, "ulimit -f 8; \"$hexact\" subdivide cube.planes --levels 6 -o old.planes").status == 3);
  CHECK(program::read_bytes((folder.path() / "old.planes").string()) == "precious");
}

TEST_CASE("symlinks, devices and pipes as outputs", "[program]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make cube -o cube.planes && mkdir d && : > d/real.planes && ln -s d/real.planes link.planes").status == 0);
  CHECK(run(folder, "\"$hexact\" subdivide cube.planes -o link.planes && test -L link.planes && grep -q hexact-planes d/real.planes").status == 0);
  CHECK(run(folder, "mkfifo pipe && { cat pipe > got & } && \"$hexact\" subdivide cube.planes --to planes -o pipe && wait && grep -q hexact-planes got && test -p pipe").status == 0);
  CHECK(run(folder, "\"$hexact\" subdivide cube.planes --to planes -o /dev/null && test -c /dev/null").status == 0);
}

TEST_CASE("command lines that ask for what does not exist: exit 2", "[program]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make cube -o cube.planes").status == 0);
  for (const std::string line :
       {"subdivide cube.planes --to planes -o -", "subdivide cube.planes -o o.planes --arithmetic double --certificate c.cert",
        "subdivide cube.planes -o o.planes --scheme nonsense", "subdivide cube.planes -o o.planes --parameters nonsense",
        "subdivide cube.planes -o o.planes --levels -1", "subdivide cube.planes -o o.nonsense", "nonsense", "make nonsense -o o.planes",
        "certify cube.planes --prove nonsense"}) {
    expect_rejected(folder, "\"$hexact\" " + line, 2, "");
  }
  CHECK(run(folder, "\"$hexact\"").status == 2);
  CHECK(run(folder, "\"$hexact\" --help").status == 0);
  CHECK(run(folder, "\"$hexact\" subdivide --help").status == 0);
  CHECK(run(folder, "\"$hexact\" --version").status == 0);
}

TEST_CASE("bounds are reported before the work: exit 4", "[program]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make cube -o cube.planes").status == 0);
  expect_rejected(folder, "\"$hexact\" subdivide cube.planes --levels 12 -o o.planes --max-facets 1000", 4, "");
  expect_rejected(folder, "\"$hexact\" subdivide cube.planes --levels 12 -o o.planes --max-memory 1MiB", 4, "");
  expect_rejected(folder, "\"$hexact\" subdivide cube.planes --levels 60 -o o.planes", 4, "");
}

TEST_CASE("the number of threads changes no output", "[program]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make random 12 3 -o r.planes").status == 0);
  CHECK(run(folder, "for n in 1 2 3; do \"$hexact\" subdivide r.planes --levels 5 -o t$n.planes --certificate t$n.cert --threads $n || exit 9; done; "
                    "cmp t1.planes t2.planes && cmp t1.planes t3.planes && cmp t1.cert t2.cert && \"$check\" t3.cert").status == 0);
}
