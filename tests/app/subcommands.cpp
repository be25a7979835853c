// SPDX-License-Identifier: GPL-3.0-or-later
// make, convert, info, prepare and subdivide through the program: formats, options, reports.
#include "program.hpp"

#include "hexact/exact/sample_solids.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <cstring>
#include <regex>
#include <set>

using namespace hexact;
using nlohmann::json;
using program::run;

namespace {

/// The report of a command that must succeed.
json report(const program::Folder& folder, const std::string& command) {
  const program::Run result = run(folder, "\"$hexact\" " + command + " --json");
  CAPTURE(command, result.out, result.err);
  REQUIRE(result.status == 0);
  return json::parse(result.out);
}

std::string bytes(const program::Folder& folder, const std::string& name) {
  return program::read_bytes((folder.path() / name).string());
}

}  // namespace

TEST_CASE("make writes every sample, exactly in .planes where it is convex", "[program][make]") {
  const program::Folder folder;
  std::vector<std::string> names = {"prism 7", "random 9 4"};  // grid M N is in the tests of samples
  for (const SampleName& s : sample_names()) names.push_back(s.name);
  for (const std::string& name : names) {
    CAPTURE(name);
    const json made = report(folder, "make " + name + " -o sample.off");
    const json info = report(folder, "info sample.off");
    CHECK(info.at("vertices") == made.at("vertices"));
    CHECK(info.at("edges") == made.at("edges"));
    CHECK(info.at("faces") == made.at("faces"));
    CHECK(info.at("orientable") == true);
    // The corner of seven cubes has vertices within its edges and facets, which no three planes define.
    const bool solid = name != "torus" && name != "saddle" && name != "seven-cubes-corner";
    CHECK(info.at("closed") == (name != "saddle"));
    CHECK(run(folder, "\"$hexact\" make " + name + " -o sample.planes").status == (solid ? 0 : 3));
    if (!solid) continue;
    const json exact = report(folder, "info sample.planes --exact");
    for (const char* key : {"planar", "closed", "manifold"}) CHECK(exact.at(key) == true);
    const std::set<std::string> reflex{"seven-cubes", "l-prism", "u-prism", "star-prism", "frame"};
    CHECK(exact.at("convex") == (reflex.count(name) == 0));
    CHECK(exact.at("euler") == (name == "frame" ? 0 : 2));
    CHECK(exact.at("volume_exact").is_string());
  }
}

TEST_CASE("info --exact tells volumes in Q and in Q(sqrt5)", "[program][info]") {
  const program::Folder folder;
  const auto volume = [&](const std::string& name) {
    REQUIRE(run(folder, "\"$hexact\" make " + name + " -o s.planes").status == 0);
    return report(folder, "info s.planes --exact").at("volume_exact").get<std::string>();
  };
  CHECK(volume("cube") == "8");
  CHECK(volume("tetrahedron") == "8/3");
  CHECK(volume("octahedron") == "4/3");
  CHECK(volume("dodecahedron").find("*sqrt5") != std::string::npos);
  REQUIRE(run(folder, "\"$hexact\" make cube -o c.planes && \"$hexact\" subdivide c.planes --arithmetic rational --levels 2 -o c2.planes").status == 0);
  CHECK(report(folder, "info c2.planes --exact").at("volume_exact") == "33877/9680");
  CHECK_FALSE(report(folder, "info c2.planes").contains("volume_exact"));
  CHECK(run(folder, "\"$hexact\" info c2.planes --exact").out.find("33877/9680") != std::string::npos);
}

TEST_CASE("convert: every format comes back bit for bit", "[program][convert]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make cube -o c.planes && \"$hexact\" subdivide c.planes --levels 3 -o s.planes --certificate s.cert").status == 0);
  // Polygons with numbered vertices: through any of them and back to the same bytes.
  const std::vector<std::pair<std::string, std::string>> polygons = {{"obj", "obj"}, {"off", "off"}, {"ply", "ply"}, {"ply", "ply-ascii"}};
  for (const auto& [ending, format] : polygons) {
    REQUIRE(run(folder, "\"$hexact\" convert s.planes --to " + format + " -o first-" + format + "." + ending).status == 0);
  }
  for (const auto& [ending, format] : polygons) {
    for (const auto& [other_ending, other] : polygons) {
      CAPTURE(format, other);
      REQUIRE(run(folder, "\"$hexact\" convert first-" + format + "." + ending + " --to " + other + " -o there." + other_ending +
                          " && \"$hexact\" convert there." + other_ending + " --to " + format + " -o back." + ending).status == 0);
      // OFF has no addresses; from the others they come back too.
      const bool same = other != "off" || format == "off";
      CHECK((bytes(folder, "back." + ending) == bytes(folder, "first-" + format + "." + ending)) == same);
      CHECK(run(folder, "\"$hexact\" check s.cert back." + ending).status == 0);
    }
  }
  // Triangles, float32 and double.
  for (const std::string format : {"stl", "stl-ascii"}) {
    CAPTURE(format);
    REQUIRE(run(folder, "\"$hexact\" convert s.planes --to " + format + " -o a.stl && \"$hexact\" convert a.stl -o a.off && \"$hexact\" convert a.off --to " +
                        format + " -o b.stl").status == 0);
    CHECK(bytes(folder, "a.stl") == bytes(folder, "b.stl"));
    CHECK(run(folder, "\"$hexact\" check s.cert a.stl").status == 0);
  }
  REQUIRE(run(folder, "\"$hexact\" convert s.planes --to ply-float -o f.ply && \"$hexact\" convert f.ply -o f.off && \"$hexact\" convert f.off --to ply-float -o g.ply").status == 0);
  CHECK(run(folder, "\"$hexact\" check s.cert f.ply").status == 0);
  CHECK(run(folder, "\"$hexact\" check s.cert f.off").status == 1);  // text that spells floats is not the rounding to doubles
  // Exact files, also through standard input and output, and from a certificate.
  REQUIRE(run(folder, "\"$hexact\" convert - --to planes -o - < s.planes > t.planes && \"$hexact\" convert s.cert -o u.planes").status == 0);
  CHECK(bytes(folder, "t.planes") == bytes(folder, "s.planes"));
  CHECK(bytes(folder, "u.planes") == bytes(folder, "s.planes"));
  REQUIRE(run(folder, "\"$hexact\" make dodecahedron -o d.planes && \"$hexact\" convert d.planes -o e.planes").status == 0);
  CHECK(bytes(folder, "d.planes") == bytes(folder, "e.planes"));
  REQUIRE(run(folder, "\"$hexact\" convert c.planes -o c.scad && grep -q 'polyhedron(' c.scad").status == 0);
  CHECK(run(folder, "\"$hexact\" convert s.planes -o x.cert").status == 2);
}

TEST_CASE("convert reports whether the file is exact, and the bound of the rounding", "[program][convert]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make cube -o c.planes && \"$hexact\" make random12 -o r.planes").status == 0);
  const json same = report(folder, "convert c.planes -o c2.planes");
  CHECK(same.at("exact") == true);
  CHECK(same.at("max_rounding") == 0);
  const json doubles = report(folder, "convert r.planes -o r.obj"), floats = report(folder, "convert r.planes -o r.stl");
  CHECK(doubles.at("exact") == false);
  CHECK(doubles.at("max_rounding").get<double>() > 0);
  CHECK(doubles.at("max_rounding").get<double>() < 1e-14);
  CHECK(floats.at("max_rounding").get<double>() > 1e-9);
  CHECK(floats.at("max_rounding").get<double>() < 1e-5);
}

TEST_CASE("--color by level and by angle; formats without colours keep silent", "[program][color]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make cube -o c.planes && \"$hexact\" subdivide c.planes --levels 3 -o s.planes").status == 0);
  for (const std::string by : {"level", "angle"}) {
    CAPTURE(by);
    REQUIRE(run(folder, "\"$hexact\" convert s.planes --to ply-ascii -o s.ply --color " + by).status == 0);
    const std::string text = bytes(folder, "s.ply");
    CHECK(text.find("property uchar red\nproperty uchar green\nproperty uchar blue\n") != std::string::npos);
    std::set<std::string> colours;
    const std::regex last_three(R"( ([0-9]+ [0-9]+ [0-9]+)\n)");
    for (std::sregex_iterator it(text.begin() + static_cast<long>(text.find("end_header")) + 216 * 5, text.end(), last_three), end; it != end; ++it) {
      colours.insert((*it)[1]);
    }
    CHECK(colours.size() > 2);
    // The colours change nothing else, and are the same from subdivide.
    REQUIRE(run(folder, "\"$hexact\" convert s.planes --to ply -o plain.ply && \"$hexact\" convert s.planes --to ply -o coloured.ply --color " + by +
                        " && \"$hexact\" subdivide c.planes --levels 3 --to ply -o direct.ply --color " + by +
                        " && \"$hexact\" convert coloured.ply -o a.off && \"$hexact\" convert plain.ply -o b.off").status == 0);
    CHECK(bytes(folder, "a.off") == bytes(folder, "b.off"));
    CHECK(bytes(folder, "direct.ply") == bytes(folder, "coloured.ply"));
    CHECK(bytes(folder, "plain.ply").size() < bytes(folder, "coloured.ply").size());
    REQUIRE(run(folder, "\"$hexact\" convert s.planes -o s.off --color " + by).status == 0);
  }
  CHECK(run(folder, "\"$hexact\" convert s.planes -o s.ply --color rainbow").status == 2);
}

TEST_CASE("--unit labels files that have a place for it and changes no number", "[program][unit]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make cube -o c.planes").status == 0);
  for (const std::string unit : {"mm", "m", "in"}) {
    for (const std::string format : {"obj", "off", "ply"}) {
      REQUIRE(run(folder, "\"$hexact\" convert c.planes -o labelled." + format + " --unit " + unit + " && \"$hexact\" convert c.planes -o plain." + format).status == 0);
      CHECK(bytes(folder, "labelled." + format).find("unit " + unit + "\n") != std::string::npos);
      REQUIRE(run(folder, "\"$hexact\" convert labelled." + format + " -o a." + format).status == 0);
      CHECK(bytes(folder, "a." + format) == bytes(folder, "plain." + format));
    }
    CHECK(run(folder, "\"$hexact\" info c.planes --unit " + unit).out.find(" " + unit + "^3") != std::string::npos);
    CHECK(report(folder, "info c.planes --unit " + unit).at("volume") == 8.0);
  }
  CHECK(run(folder, "\"$hexact\" info c.planes --unit ell").status == 2);
}

TEST_CASE("prepare: options work in their documented order, whatever the order on the command line", "[program][prepare]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make octahedron -o o.planes && \"$hexact\" make icosahedron -o i.planes").status == 0);
  const auto same = [&](const std::string& one, const std::string& other) {
    REQUIRE(run(folder, "\"$hexact\" prepare o.planes -o one.planes " + one + " && \"$hexact\" prepare o.planes -o other.planes " + other).status == 0);
    CHECK(bytes(folder, "one.planes") == bytes(folder, "other.planes"));
  };
  same("--truncate --snap 20", "--snap 20 --truncate");
  same("--hull --truncate=1/4", "--truncate=1/4 --hull");
  same("--dual --corner-cut=1/5", "--corner-cut=1/5 --dual");
  const json truncated = report(folder, "prepare o.planes -o t.planes --truncate");
  CHECK(truncated.at("truncated_vertices") == 6);
  CHECK(truncated.at("merged_facets") == 0);
  CHECK(truncated.at("max_displacement") == 0);
  CHECK(truncated.at("vertices") == 24);
  CHECK(truncated.at("faces") == 14);
  CHECK(report(folder, "prepare i.planes -o t.planes --truncate=2/5").at("faces") == 32);
  const json triangles = report(folder, "prepare t.planes -o t.off --triangulate");
  CHECK(triangles.at("faces") == 2 * triangles.at("vertices").get<int>() - 4);
  const json snapped = report(folder, "prepare i.planes -o n.planes --truncate --snap 12");
  CHECK(snapped.at("max_displacement").get<double>() > 0);
  CHECK(snapped.at("max_displacement").get<double>() < 0.1);
  CHECK(report(folder, "certify n.planes").at("verdict") == "proved");
  // Merging, and the remark of formats that round.
  const json merged = report(folder, "prepare '" HEXACT_EXAMPLES "/cube_triangulated.obj' -o m.planes");
  CHECK(merged.at("merged_facets") == 6);
  CHECK(merged.at("faces") == 6);
  const program::Run rounded = run(folder, "\"$hexact\" prepare i.planes -o r.obj");
  CHECK(rounded.err.find(".planes") != std::string::npos);
  CHECK(run(folder, "\"$hexact\" prepare i.planes -o r.obj --quiet").err.empty());
  for (const std::string bad : {"--truncate=1/2", "--truncate=0", "--corner-cut=x", "--snap 1"}) {
    CHECK(run(folder, "\"$hexact\" prepare o.planes -o x.planes " + bad).status == 2);
  }
}

TEST_CASE("--all-levels writes each level, the last one as the result", "[program][levels]") {
  const program::Folder folder;
  REQUIRE(run(folder, "\"$hexact\" make cube -o c.planes").status == 0);
  const json made = report(folder, "subdivide c.planes --levels 3 -o out.planes --all-levels 'level%02d.planes'");
  REQUIRE(made.at("levels").size() == 4);
  for (int l = 1; l <= 3; ++l) {
    const std::string name = "level0" + std::to_string(l) + ".planes";
    CHECK(report(folder, "info " + name).at("faces") == made.at("levels")[l].at("faces"));
  }
  CHECK(bytes(folder, "level03.planes") == bytes(folder, "out.planes"));
  REQUIRE(run(folder, "\"$hexact\" subdivide c.planes --levels 2 -o out.planes --all-levels '%d.obj'").status == 0);
  CHECK(report(folder, "info 2.obj").at("faces") == 38);
  for (const std::string bad : {"level.planes", "level%s.planes", "level%"}) {
    CHECK(run(folder, "\"$hexact\" subdivide c.planes --levels 1 -o out.planes --all-levels '" + bad + "'").status == 2);
  }
}

TEST_CASE("errors are one JSON object with code, message and place", "[program][json]") {
  const program::Folder folder;
  program::write_bytes((folder.path() / "bad.obj").string(), "v 0 0 0\nv 1 0 x\n");
  REQUIRE(run(folder, "\"$hexact\" make octahedron -o o.planes && \"$hexact\" make cube -o c.planes").status == 0);
  const auto error = [&](const std::string& command, int status) {
    const program::Run result = run(folder, "\"$hexact\" " + command + " --json");
    CAPTURE(command, result.out, result.err);
    CHECK(result.status == status);
    const json document = json::parse(result.out);
    CHECK(document.size() == 1);
    CHECK(document.at("error").size() == 5);
    CHECK(result.err.find(document.at("error").at("message").get<std::string>()) != std::string::npos);
    return document.at("error");
  };
  json e = error("info bad.obj", 3);
  CHECK(e.at("code") == "ParseError");
  CHECK(e.at("file") == "bad.obj");
  CHECK(e.at("line") == 2);
  e = error("subdivide o.planes -o x.planes", 3);
  CHECK(e.at("code") == "NotTrivalent");
  CHECK(e.at("element").get<std::string>().find("vertex") == 0);
  CHECK(e.at("line").is_null());
  CHECK(error("info nothing.obj", 3).at("code") == "FileError");
  CHECK(error("subdivide c.planes -o x.planes --levels 5 --max-facets 10", 4).at("code") == "ResourceLimit");
  CHECK(error("nonsense", 2).at("code") == "Usage");
  CHECK(error("subdivide c.planes -o x.planes --parameters constant=1/2", 3).at("code") == "ParameterOutOfRange");
  CHECK(error("convert c.planes -o -", 2).at("code") == "Usage");
}

TEST_CASE("the manual and the guide name every subcommand and every option of --help", "[program][manual]") {
  const program::Folder folder;
  std::string manual = program::read_bytes(HEXACT_SOURCE_DIR "/docs/hexact.1");
  manual.erase(std::remove(manual.begin(), manual.end(), '\\'), manual.end());
  const std::string guide = program::read_bytes(HEXACT_SOURCE_DIR "/docs/command-line.md");
  const std::string help = run(folder, "\"$hexact\" --help").out;
  const std::regex subcommand(R"(\n  ([a-z]+) )"), option(R"(--[a-z][a-z-]*)");
  std::set<std::string> commands;
  for (std::sregex_iterator it(help.begin() + static_cast<long>(help.find("Subcommands:")), help.end(), subcommand), end; it != end; ++it) commands.insert((*it)[1]);
  CHECK(commands.size() >= 8);
  for (const std::string& command : commands) {
    CAPTURE(command);
    CHECK(manual.find("BI " + command + " ") != std::string::npos);
    CHECK(guide.find("\n## " + command + "\n") != std::string::npos);
    const program::Run shown = run(folder, "\"$hexact\" " + command + " --help");
    REQUIRE(shown.status == 0);
    std::size_t options = 0;
    for (std::sregex_iterator it(shown.out.begin(), shown.out.end(), option), end; it != end; ++it, ++options) {
      const std::string name = it->str();
      if (name == "--help") continue;
      CAPTURE(name);
      CHECK(manual.find(name) != std::string::npos);
      if (name != "--output") CHECK(guide.find(name) != std::string::npos);
    }
    CHECK(options >= 8);  // those that all subcommands have
  }
  // And it is a manual page that can be shown.
  CHECK(manual.find(".TH HEXACT 1") != std::string::npos);
}
