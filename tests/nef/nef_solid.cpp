// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/nef/nef_solid.hpp"

#include "chamfer_samples.hpp"
#include "hexact/kernel/errors.hpp"
#include "solid_samples.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <vector>

using namespace hexact;

namespace {

/// The body with half-space i moved outward by one unit; loops and triples as before.
PlaneBody moved(const PlaneBody& body, std::size_t i, int by) {
  PlaneBody result = body;
  Plane<Integer> p = body.planes[i];
  p.d += Integer(by);
  result.planes.set(i, p);
  return result;
}

/// An L-shaped prism: closed and planar, not convex.
PlaneBody notched() {
  PlaneBody body;
  // x >= 0, y >= 0, x <= 2, y <= 2, and the notch x <= 1, y <= 1; z between 0 and 1.
  const std::vector<samples::Row> rows = {{-1, 0, 0, 0}, {0, -1, 0, 0}, {1, 0, 0, 2}, {0, 1, 0, 1},
                                          {1, 0, 0, 1},  {0, 1, 0, 2},  {0, 0, -1, 0}, {0, 0, 1, 1}};
  const std::vector<std::size_t> around = {1, 2, 3, 4, 5, 0};  // outline counter-clockwise from (0, 0)
  for (const auto& r : rows) body.planes.push_back(samples::to_plane(r));
  body.addresses.resize(rows.size());
  const auto f = [](std::size_t i) { return make_id<FacetId>(i); };
  for (const std::size_t z : {6, 7}) {
    for (std::size_t i = 0; i < 6; ++i) body.triples.push_back({f(around[(i + 5) % 6]), f(around[i]), f(z)});
  }
  std::vector<std::vector<std::size_t>> loops(8);
  for (std::size_t i = 0; i < 6; ++i) {
    const std::size_t j = (i + 1) % 6;
    loops[around[i]] = {i, j, j + 6, i + 6};
    loops[6].insert(loops[6].begin(), i);
    loops[7].push_back(i + 6);
  }
  for (const auto& loop : loops) {
    for (const std::size_t v : loop) body.loops.add_corner(make_id<VertexId>(v));
    body.loops.close_loop();
  }
  return body;
}

}  // namespace

TEST_CASE("Nef proves a cube and its honeycomb convex", "[nef]") {
  CHECK(nef_convex(samples::cube()).verdict == Verdict::proved);
  CHECK(nef_convex(samples::tetrahedron()).verdict == Verdict::proved);
  const PlaneBody octahedron = samples::honeycomb(samples::cube(), 1);
  REQUIRE(octahedron.planes.size() == 14);
  CHECK(nef_convex(octahedron).verdict == Verdict::proved);
}

TEST_CASE("Nef refutes convexity with a witness", "[nef]") {
  const ClaimVerdict notch = nef_convex(notched());
  CHECK(notch.verdict == Verdict::refuted);
  // A corner with y = 2 is beyond y <= 1 by exactly 1.
  CHECK(notch.witness.find("facet 3") != std::string::npos);
  CHECK(notch.witness.find("= 1") != std::string::npos);
}

TEST_CASE("Nef refutes loops that bound nothing", "[nef]") {
  PlaneBody open = samples::cube();
  FacetLoops loops;
  for (std::size_t f = 0; f + 1 < open.loops.size(); ++f) loops.add(open.loops[f]);
  loops.close_loop();  // the last plane keeps no facet
  open.loops = loops;
  const ClaimVerdict verdict = nef_convex(open);
  CHECK(verdict.verdict == Verdict::refuted);
  CHECK(verdict.witness.find("closed") != std::string::npos);

  PlaneBody inverted = samples::cube();
  inverted.loops = {};
  for (std::size_t f = 0; f < open.loops.size(); ++f) {
    const auto loop = samples::cube().loops;
    for (auto v = loop[f].rbegin(); v != loop[f].rend(); ++v) inverted.loops.add_corner(*v);
    inverted.loops.close_loop();
  }
  CHECK(nef_convex(inverted).witness.find("counter-clockwise") != std::string::npos);

  PlaneBody bent = samples::cube();
  bent.triples[0] = bent.triples[1];  // a corner of a facet whose plane does not contain it
  CHECK(nef_convex(bent).verdict == Verdict::refuted);
}

TEST_CASE("Nef confirms that one honeycomb step is a cut by half-spaces", "[nef]") {
  const PlaneBody cube = samples::cube();
  const PlaneBody octahedron = samples::honeycomb(cube, 1);
  CHECK(nef_corner_cut(cube, octahedron).verdict == Verdict::proved);
  // The cut body is not what remains of a larger or of a smaller cube whose corners are elsewhere.
  CHECK(nef_corner_cut(octahedron, cube).verdict == Verdict::refuted);
  const PlaneBody level2 = samples::honeycomb(cube, 2);
  CHECK(nef_corner_cut(octahedron, level2).verdict == Verdict::proved);
}

TEST_CASE("Nef decides containment by an empty difference", "[nef]") {
  const PlaneBody cube = samples::cube(), octahedron = samples::honeycomb(cube, 1);
  CHECK(nef_inside(octahedron, cube).verdict == Verdict::proved);
  CHECK(nef_inside(cube, cube).verdict == Verdict::proved);
  const ClaimVerdict outside = nef_inside(cube, octahedron);
  CHECK(outside.verdict == Verdict::refuted);
  CHECK(outside.witness.find("point (") == 0);
  // One unit is enough to see the difference between two frames.
  const PlaneBody grown = moved(samples::cube(1000), 1, 1);
  CHECK(nef_inside(samples::cube(1000), grown).verdict == Verdict::proved);
  CHECK(nef_inside(grown, samples::cube(1000)).verdict == Verdict::refuted);
}

TEST_CASE("Nef compares bodies in file coordinates", "[nef]") {
  PlaneBody halves = samples::cube(2);
  halves.scale = -1;
  CHECK(nef_corner_cut(samples::cube(1), halves).verdict == Verdict::proved);
  halves.shift[0] = Rational(1);
  CHECK(nef_corner_cut(samples::cube(1), halves).verdict == Verdict::refuted);
  CHECK(nef_inside(halves, samples::cube(2)).verdict == Verdict::proved);
}

TEST_CASE("Nef refuses what costs too much and says how much", "[nef]") {
  NefOptions options;
  options.max_facets = 5;
  try {
    (void)nef_convex(samples::cube(), options);
    FAIL("no bound");
  } catch (const ResourceLimit& e) {
    CHECK(std::string(e.what()).find("cut by cut") != std::string::npos);
  }
  CHECK(nef_cost_seconds(326) == Approx(3.3));
  CHECK(nef_cost_seconds(974) > 25);
  CHECK(nef_cost_seconds(974) < 50);
  CHECK(nef_cost_estimate(100000).find("hours") != std::string::npos);
}

TEST_CASE("Nef work reports a monotone fraction and can be cancelled", "[nef]") {
  std::vector<double> seen;
  NefOptions options;
  options.progress = [&](double f) { seen.push_back(f); return true; };
  CHECK(nef_convex(samples::cube(), options).verdict == Verdict::proved);
  REQUIRE(seen.size() > 6);
  CHECK(std::is_sorted(seen.begin(), seen.end()));
  CHECK(seen.back() == 1.0);
  options.progress = [](double) { return false; };
  const ClaimVerdict stopped = nef_convex(samples::cube(), options);
  CHECK(stopped.verdict == Verdict::undecided);
  CHECK(stopped.witness == "cancelled");
}

TEST_CASE("Nef leaves bodies over Q(sqrt5) undecided", "[nef]") {
  PlaneBody body;
  body.field = Field::sqrt5;
  const ClaimVerdict verdict = nef_convex(body);
  CHECK(verdict.verdict == Verdict::undecided);
  CHECK(verdict.witness.find("sqrt5") != std::string::npos);
}

TEST_CASE("Nef agrees about chamfers: convex, cut from the solid before, inside it", "[nef][chamfer]") {
  const PlaneBody cube = samples::cube();
  const PlaneBody two = samples::chamfer(cube, 2);
  REQUIRE(two.plane_count() == 66);
  CHECK(nef_convex(two).verdict == Verdict::proved);
  CHECK(nef_corner_cut(cube, two).verdict == Verdict::proved);
  CHECK(nef_inside(two, cube).verdict == Verdict::proved);
  const PlaneBody behind = samples::chamfer(samples::honeycomb(cube, 1), 1, 2);
  CHECK(nef_corner_cut(cube, behind).verdict == Verdict::proved);
  CHECK(nef_corner_cut(two, samples::chamfer(cube, 1)).verdict == Verdict::refuted);
}
