// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/validation/openscad_crosscheck.hpp"

#include "chamfer_samples.hpp"
#include "hexact/kernel/errors.hpp"
#include "hexact/validation/child_process.hpp"
#include "solid_samples.hpp"

#include <catch2/catch.hpp>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

using namespace hexact;
using namespace hexact::validation;

namespace {

/// A shell script that stands in for OpenSCAD; called as SCRIPT -o MESH PROGRAM.
class FakeOpenscad {
 public:
  explicit FakeOpenscad(const std::string& body) : file_(folder_.path() / "fake-openscad") {
    std::ofstream(file_) << "#!/bin/sh\n" << body << "\n";
    std::filesystem::permissions(file_, std::filesystem::perms::owner_all);
  }
  [[nodiscard]] CrosscheckReport check(const PlaneBody& body, double limit = 30) const {
    CrosscheckOptions options;
    options.openscad = file_.string();
    options.time_limit = limit;
    return crosscheck_openscad(body, options);
  }

 private:
  TemporaryFolder folder_;
  std::filesystem::path file_;
};

CrosscheckReport check(const PlaneBody& body, std::vector<Route> routes = {Route::intersection}) {
  CrosscheckOptions options;
  options.routes = std::move(routes);
  const CrosscheckReport report = crosscheck_openscad(body, options);
  for (const auto& r : report.routes) {
    INFO(name_of(r.route) << " " << r.reason);
    CHECK(r.verdict == Agreement::agree);
    REQUIRE(r.volume_difference);
    REQUIRE(r.bound);
    CHECK(*r.volume_difference <= *r.bound);
    CHECK(r.openscad == report.ours);
  }
  return report;
}

const std::string kCubeCounts = "echo '   Simple:        yes'; echo '   Vertices:        8'; echo '   Edges:          12'; echo '   Facets:          6'";

}  // namespace

TEST_CASE("OpenSCAD's own Booleans build the same levels", "[validation][openscad]") {
  const std::vector<Route> all = {Route::intersection, Route::hull, Route::difference};
  CHECK(check(samples::cube(), all).ours == ElementCounts{8, 12, 6});
  CHECK(check(samples::tetrahedron(), all).ours == ElementCounts{4, 6, 4});
  CHECK(check(samples::honeycomb(samples::cube(), 1), all).ours == ElementCounts{24, 36, 14});
  CHECK(check(samples::honeycomb(samples::cube(), 2), all).ours == ElementCounts{72, 108, 38});
  CHECK(check(samples::honeycomb(samples::tetrahedron(), 2), all).ours == ElementCounts{36, 54, 20});
}

TEST_CASE("OpenSCAD agrees about a generic solid with 12 facets", "[validation][openscad]") {
  const PlaneBody generic = samples::generic_dodecahedron();
  CHECK(check(generic, {Route::intersection, Route::hull, Route::difference}).ours == ElementCounts{20, 30, 12});
  CHECK(check(samples::honeycomb(generic, 1)).ours == ElementCounts{60, 90, 32});
}

TEST_CASE("OpenSCAD builds the same chamfers, alone and behind a honeycomb", "[validation][openscad][chamfer]") {
  CHECK(check(samples::chamfer(samples::cube(), 1), {Route::intersection, Route::hull, Route::difference}).ours == ElementCounts{32, 48, 18});
  CHECK(check(samples::chamfer(samples::cube(), 2)).ours == ElementCounts{128, 192, 66});
  CHECK(check(samples::chamfer(samples::honeycomb(samples::tetrahedron(), 1), 1, 2)).ours == ElementCounts{48, 72, 26});
}

TEST_CASE("Normals of 45 bits pass through OpenSCAD unchanged", "[validation][openscad]") {
  // Corners beyond 2^42 stand in the program with binary fractions.
  const PlaneBody near = samples::generic_dodecahedron();
  std::vector<samples::Row> rows;
  long long low = 0x2f7b3c5;
  for (std::size_t i = 0; i < 12; ++i) {
    const auto widened = [&](const Integer& c) {
      low = (low * 25214903917LL + 11) & ((1LL << 28) - 1);
      return (c.to_int64() * (1LL << 34) + 61 * low) | 1;
    };
    const Plane<Integer> p = near.planes[i];
    rows.push_back({widened(p.a), widened(p.b), widened(p.c), p.d.to_int64()});
  }
  const PlaneBody body = samples::simple_body(rows);
  REQUIRE(scad_model(body).corner_bits > 42);
  REQUIRE(scad_model(body).fraction_bits > 0);
  CHECK(check(body, {Route::intersection, Route::difference}).ours == ElementCounts{20, 30, 12});
}

TEST_CASE("OpenSCAD differs where the mesh is not what its planes make", "[validation][openscad]") {
  PlaneBody body = samples::cube();
  // Facet 5 is split along a diagonal: two facets in one plane, which exact Booleans merge.
  const auto loop = body.loops[5];
  FacetLoops loops;
  for (std::size_t f = 0; f < 5; ++f) loops.add(body.loops[f]);
  loops.add(std::vector<VertexId>{loop[0], loop[1], loop[2]});
  loops.add(std::vector<VertexId>{loop[0], loop[2], loop[3]});
  body.loops = loops;
  body.planes.push_back(body.planes[5]);
  body.addresses.push_back({});
  const CrosscheckReport report = crosscheck_openscad(body);
  CHECK(report.verdict == Agreement::differ);
  CHECK(report.ours.facets == 7);
  REQUIRE(report.routes[0].openscad);
  CHECK(report.routes[0].openscad->facets == 6);
  CHECK(report.reason.find("6 facets") != std::string::npos);
}

TEST_CASE("A missing, failing, hanging or babbling OpenSCAD is not checked", "[validation]") {
  const PlaneBody cube = samples::cube();
  const auto not_checked = [](const CrosscheckReport& report, const std::string& why) {
    INFO(report.reason);
    CHECK(report.verdict == Agreement::not_checked);
    CHECK(report.reason.find(why) != std::string::npos);
  };
  CrosscheckOptions missing;
  missing.openscad = "/nowhere/openscad";
  not_checked(crosscheck_openscad(cube, missing), "is OpenSCAD installed");
  not_checked(FakeOpenscad("echo broken >&2; exit 3").check(cube), "exit status 3: broken");
  not_checked(FakeOpenscad("kill -SEGV $$").check(cube), "signal 11");
  not_checked(FakeOpenscad("echo hello; exit 0").check(cube), "printed no counts");
  not_checked(FakeOpenscad(kCubeCounts).check(cube), "wrote no mesh");
  not_checked(FakeOpenscad(kCubeCounts + "; echo nonsense > \"$2\"").check(cube), "cannot be read, line 1");
  not_checked(FakeOpenscad(kCubeCounts + "; echo 'OFF 99999999999 1 0' > \"$2\"").check(cube), "cannot be read");
  not_checked(FakeOpenscad(kCubeCounts + "; printf 'OFF 3 1 0\\n0 0 0\\n1 0 0\\nnan 1 0\\n3 0 1 2\\n' > \"$2\"").check(cube), "line 4");
  const auto start = std::chrono::steady_clock::now();
  not_checked(FakeOpenscad("sleep 600 & wait").check(cube, 0.2), "time limit");
  CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(10));
}

TEST_CASE("A wrong solid from OpenSCAD differs", "[validation][openscad]") {
  const PlaneBody cube = samples::cube();
  const auto differs = [](const CrosscheckReport& report, const std::string& why) {
    INFO(report.reason);
    CHECK(report.verdict == Agreement::differ);
    CHECK(report.reason.find(why) != std::string::npos);
  };
  differs(FakeOpenscad("echo 'Simple: no'; echo 'Vertices: 8'; echo 'Edges: 12'; echo 'Facets: 6'").check(cube), "simple");
  differs(FakeOpenscad(kCubeCounts + "; echo 'OFF 0 0 0' > \"$2\"").check(cube), "empty");
  // The real program, with one edge a ten-thousandth longer: same counts, other points.
  const std::string altered = "sed 's/^intersection/scale([1.0001,1,1]) intersection/' \"$3\" > other.scad; openscad -o \"$2\" other.scad";
  differs(FakeOpenscad(altered).check(cube), "is none of ours");
  // The same without the alteration agrees, so it is the alteration that is seen.
  CHECK(FakeOpenscad("openscad -o \"$2\" \"$3\"").check(cube).verdict == Agreement::agree);
  // A triangle left out: the surface is open.
  differs(FakeOpenscad("openscad -o \"$2\" \"$3\"; sed -i -e 's/^OFF 8 12/OFF 8 11/' -e '$d' \"$2\"").check(cube), "open");
}

TEST_CASE("Too many cuts are not run, with a word on their cost", "[validation]") {
  CrosscheckOptions options;
  options.max_cuts = 5;
  options.openscad = "/nowhere/openscad";
  const CrosscheckReport report = crosscheck_openscad(samples::cube(), options);
  CHECK(report.verdict == Agreement::not_checked);
  CHECK(report.reason.find("would take about 1 s") != std::string::npos);
  CHECK(openscad_cost_seconds(974) > 80);
  CHECK(openscad_cost_seconds(974) < 130);
}

TEST_CASE("A child is found by PATH, its output kept, its folder removed", "[validation]") {
  std::filesystem::path where;
  {
    const TemporaryFolder folder;
    where = folder.path();
    const ChildResult result = run_child({"sh", "-c", "echo out; echo err >&2; pwd; exit 7"}, where, 10);
    CHECK(result.end == ChildResult::End::exited);
    CHECK(result.status == 7);
    CHECK(result.output == "out\nerr\n" + where.string() + "\n");
  }
  CHECK(!std::filesystem::exists(where));
}
