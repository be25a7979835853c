// SPDX-License-Identifier: GPL-3.0-or-later
#include "chamfer_samples.hpp"
#include "hexact/exact/certify.hpp"
#include "hexact/exact/mesh_difference.hpp"
#include "hexact/exact/honeycomb.hpp"
#include "solid_samples.hpp"

#include <catch2/catch.hpp>

using namespace hexact;

namespace {

Verdict decide(const PlaneBody& body, const Claim& claim, const PlaneBody& reference = {}) {
  std::vector<NamedBody> bodies;
  if (!claim.reference.empty()) bodies.push_back({claim.reference, reference});
  const auto verdicts = verify(make_certificate(body, {claim}, bodies, {}));
  REQUIRE(verdicts.size() == 1);
  CHECK(verdicts[0].witness.empty() == (verdicts[0].verdict == Verdict::proved));
  return verdicts[0].verdict;
}

PlaneBody with_loop(const PlaneBody& body, std::size_t facet, std::vector<VertexId> loop) {
  PlaneBody out = body;
  out.loops = FacetLoops();
  for (std::size_t f = 0; f < body.loops.size(); ++f) {
    if (f == facet) out.loops.add(loop);
    else out.loops.add(body.loops[f]);
  }
  return out;
}

}  // namespace

TEST_CASE("every claim holds for honeycombs of cube and tetrahedron", "[certify]") {
  for (const PlaneBody& base : {samples::cube(), samples::tetrahedron()}) {
    for (int k = 0; k <= 4; ++k) {
      const PlaneBody body = samples::honeycomb(base, k);
      for (const char* name : {"closed", "planar", "trivalent", "convex"}) CHECK(decide(body, {name, ""}) == Verdict::proved);
      for (const char* name : {"inside", "tangent", "corner-cut-of"}) {
        INFO(name << " level " << k);
        CHECK(decide(body, {name, "base"}, base) == Verdict::proved);
      }
    }
  }
}

TEST_CASE("inside finds supports where half-spaces are no facets, and sees what sticks out", "[certify]") {
  const PlaneBody body = samples::honeycomb(samples::cube(2), 2);
  CHECK(decide(body, {"inside", "big"}, samples::cube(3)) == Verdict::proved);
  CHECK(decide(body, {"tangent", "big"}, samples::cube(3)) == Verdict::refuted);
  CHECK(decide(body, {"inside", "small"}, samples::cube(1)) == Verdict::refuted);
  CHECK(decide(body, {"corner-cut-of", "big"}, samples::cube(3)) == Verdict::refuted);
  Certificate wrong = make_certificate(body, {{"inside", "big"}}, {{"big", samples::cube(3)}}, {});
  REQUIRE(wrong.supports.size() == 6);
  CHECK(overall(verify(wrong)) == Verdict::proved);
  std::swap(wrong.supports[0].vertex, wrong.supports[1].vertex);
  CHECK(overall(verify(wrong)) == Verdict::refuted);
  wrong.supports.clear();
  CHECK(overall(verify(wrong)) == Verdict::refuted);
}

TEST_CASE("broken bodies are refuted by the claim they break", "[certify]") {
  const PlaneBody good = samples::honeycomb(samples::cube(), 1);
  const PlaneBody open = with_loop(good, 3, {});
  CHECK(decide(open, {"closed", ""}) == Verdict::refuted);
  CHECK(decide(open, {"trivalent", ""}) == Verdict::refuted);
  CHECK(decide(open, {"convex", ""}) == Verdict::refuted);
  CHECK(decide(open, {"planar", ""}) == Verdict::proved);
  std::vector<VertexId> reversed(good.loops[2].begin(), good.loops[2].end());
  std::reverse(reversed.begin(), reversed.end());
  CHECK(decide(with_loop(good, 2, reversed), {"closed", ""}) == Verdict::refuted);
  PlaneBody bent = good;
  std::swap(bent.triples[0], bent.triples[5]);
  CHECK(decide(bent, {"planar", ""}) == Verdict::refuted);
  CHECK(decide(bent, {"closed", ""}) == Verdict::proved);
  CHECK(decide(bent, {"inside", "cube"}, samples::cube()) == Verdict::refuted);
  PlaneBody flipped = good;
  for (std::size_t i = 0; i < good.planes.size(); ++i) {
    const Plane<Integer> p = good.planes[i];
    flipped.planes.set(i, Plane<Integer>{-p.a, -p.b, -p.c, -p.d});
  }
  CHECK(decide(flipped, {"planar", ""}) == Verdict::proved);
  CHECK(decide(flipped, {"convex", ""}) == Verdict::refuted);
}

TEST_CASE("a changed address or order of planes is no corner cut", "[certify]") {
  PlaneBody body = samples::honeycomb(samples::cube(), 2);
  body.addresses[9].parent = make_id<VertexId>(6);
  CHECK(decide(body, {"corner-cut-of", "base"}, samples::cube()) == Verdict::refuted);
  CHECK(decide(body, {"convex", ""}) == Verdict::proved);
}

TEST_CASE("the same claims over another field", "[certify]") {
  auto level = honeycomb_start<QuadraticField>([] {
    PlaneBody b = samples::cube();
    b.field = Field::sqrt5;
    for (std::size_t i = 0; i < b.planes.size(); ++i) {
      const auto p = b.planes[i];
      b.planes_sqrt5.push_back({Rational(p.a), Rational(p.b), Rational(p.c), Rational(p.d)});
    }
    b.planes = {};
    return b;
  }());
  const PlaneBody base = to_plane_body(level);
  for (int k = 0; k < 2; ++k) level = honeycomb_step(level, static_policy_rational()).level;
  const PlaneBody body = to_plane_body(level);
  for (const char* name : {"closed", "planar", "trivalent", "convex"}) CHECK(decide(body, {name, ""}) == Verdict::proved);
  for (const char* name : {"inside", "tangent", "corner-cut-of"}) CHECK(decide(body, {name, "base"}, base) == Verdict::proved);
}

TEST_CASE("claims that do not exist or name no body are errors", "[certify]") {
  CHECK_THROWS_AS(make_certificate(samples::cube(), {{"round", ""}}, {}, {}), InvalidInput);
  CHECK_THROWS_AS(make_certificate(samples::cube(), {{"inside", "x"}}, {}, {}), InvalidInput);
  CHECK_THROWS_AS(make_certificate(samples::cube(), {{"convex", "x"}}, {}, {}), InvalidInput);
}

TEST_CASE("a mesh is the correct rounding or differs by one ulp", "[certify]") {
  const PlaneBody body = samples::honeycomb(samples::tetrahedron(), 2);
  PolygonSoup<Rational> mesh;
  for (const auto& p : rounded_vertices(body).points) {
    mesh.points.push_back({Rational::from_double(p.x), Rational::from_double(p.y), Rational::from_double(p.z)});
  }
  mesh.facets = body.loops;
  CHECK(mesh_difference(body, mesh).empty());
  for (std::size_t v = 0; v < mesh.points.size(); v += 7) {
    PolygonSoup<Rational> moved = mesh;
    moved.points[v].y = Rational::from_double(std::nextafter(mesh.points[v].y.to_double(), 9.0));
    CHECK_FALSE(mesh_difference(body, moved).empty());
  }
}

TEST_CASE("every claim holds for chamfers, alone and behind honeycombs", "[certify][chamfer]") {
  const auto all_hold = [](const PlaneBody& body, const PlaneBody& base) {
    for (const char* name : {"closed", "planar", "trivalent", "convex"}) CHECK(decide(body, {name, ""}) == Verdict::proved);
    for (const char* name : {"inside", "tangent", "corner-cut-of"}) CHECK(decide(body, {name, "base"}, base) == Verdict::proved);
  };
  for (const PlaneBody& base : {samples::cube(), samples::tetrahedron()}) {
    for (std::uint32_t k = 1; k <= 3; ++k) {
      const PlaneBody body = samples::chamfer(base, k);
      const std::size_t vertices = base.vertex_count() << (2 * k);
      CHECK(body.vertex_count() == vertices);
      CHECK(body.loops.corner_count() == 3 * vertices);
      all_hold(body, base);
    }
  }
  all_hold(samples::chamfer(samples::generic_dodecahedron(), 2, 1, 40), samples::generic_dodecahedron());
  all_hold(samples::chamfer(samples::honeycomb(samples::cube(), 2), 1, 3), samples::cube());
}

TEST_CASE("an edge cut is refuted where an end of an edge is kept, a level is missing, or a map is another", "[certify][chamfer]") {
  const PlaneBody base = samples::cube();
  const PlaneBody one = samples::with_equal_normals(base, 12);
  const auto reason = [&](const PlaneBody& body) {
    const auto verdicts = verify(make_certificate(body, {{"corner-cut-of", "base"}}, {{"base", base}}, {}));
    return verdicts[0].witness;
  };
  const PlaneBody good = samples::chamfer(base, 2);
  CHECK(reason(good).empty());
  PlaneBody relabelled = good;
  for (FacetAddress& a : relabelled.addresses) a.level = std::min(a.level, 1u);
  CHECK(reason(relabelled).find("level 1: 60 planes follow") == 0);
  PlaneBody other_parent = good;
  std::swap(other_parent.addresses[20].parent, other_parent.addresses[30].parent);
  CHECK(reason(other_parent).find("facet 20: level or parent") == 0);
  // Lifts 0: every plane passes through its edge and cuts nothing; the level is no strictly convex solid.
  CHECK_FALSE(reason(samples::chamfer_step(one, 1, [](std::size_t, std::size_t, std::size_t) { return Integer(0); })).empty());
  // A solid whose first level is the cube and whose edge planes are those of the second: the lift of one edge so large
  // that the facet beside it loses a side.
  const PlaneBody steep = samples::chamfer_step(one, 1, [](std::size_t e, std::size_t, std::size_t) { return Integer(e == 3 ? 1 << 14 : 1 << 10); });
  CHECK_FALSE(reason(steep).empty());
}
