// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/validation/scad_model.hpp"

#include "hexact/kernel/errors.hpp"
#include "solid_samples.hpp"

#include <catch2/catch.hpp>

#include <random>

using namespace hexact;
using namespace hexact::validation;

namespace {

Integer dot(const LatticePoint& u, const LatticePoint& v) { return u[0] * v[0] + u[1] * v[1] + u[2] * v[2]; }
LatticePoint cross(const LatticePoint& u, const LatticePoint& v) {
  return {u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
}
LatticePoint minus(const LatticePoint& u, const LatticePoint& v) { return {u[0] - v[0], u[1] - v[1], u[2] - v[2]}; }

/// Is x in the slab? Decided with its eight corners alone.
bool covers(const Slab& slab, const LatticePoint& x) {
  const LatticePoint e[3] = {minus(slab.corners[1], slab.corners[0]), minus(slab.corners[3], slab.corners[0]),
                             minus(slab.corners[4], slab.corners[0])};
  const Integer volume = dot(cross(e[0], e[1]), e[2]);
  const LatticePoint r = minus(x, slab.corners[0]);
  for (int k = 0; k < 3; ++k) {
    Integer t = dot(cross(e[(k + 1) % 3], e[(k + 2) % 3]), r), whole = volume;
    if (volume.sign() < 0) t = -t, whole = -whole;
    if (t.sign() < 0 || t > whole) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("Slabs lie exactly on their planes and cover their side of the box", "[validation]") {
  const unsigned seed = 20240613;
  INFO("seed " << seed);
  std::mt19937_64 random(seed);
  const auto number = [&](long long size) { return static_cast<long long>(random() % static_cast<unsigned long long>(2 * size + 1)) - size; };
  const LatticePoint low{Integer(-1000), Integer(-900), Integer(-1100)}, high{Integer(1000), Integer(1000), Integer(950)};
  for (int i = 0; i < 300; ++i) {
    const long long size = i % 3 == 0 ? 3 : i % 3 == 1 ? 1000 : 1000000000;
    LatticePlane plane{{Integer(number(size)), Integer(number(size)), Integer(number(size))}, Integer(number(500 * size))};
    const Integer g = gcd(gcd(plane.n[0], plane.n[1]), plane.n[2]);
    if (g.is_zero()) continue;
    for (Integer& c : plane.n) c = exact_quotient(c, g);
    const LatticeFrame frame = lattice_frame(plane);
    CHECK(dot(plane.n, frame.p) == plane.d);
    // A basis of the whole lattice of the plane: u × w = ±n. Reduced: 2 |u·w| <= u·u <= w·w.
    const LatticePoint n = cross(frame.u, frame.w);
    CHECK((n == plane.n || minus({}, n) == plane.n));
    const Integer uw = dot(frame.u, frame.w), uu = dot(frame.u, frame.u);
    CHECK((uw.sign() < 0 ? -(uw + uw) : uw + uw) <= uu);
    CHECK(uu <= dot(frame.w, frame.w));
    const Slab in = half_space_slab(plane, Side::inside, low, high), out = half_space_slab(plane, Side::outside, low, high);
    for (std::size_t k = 0; k < 4; ++k) {
      CHECK(dot(plane.n, in.corners[k]) == plane.d);
      CHECK(dot(plane.n, in.corners[k + 4]) < plane.d);
      CHECK(dot(plane.n, out.corners[k + 4]) > plane.d);
    }
    for (int j = 0; j < 20; ++j) {
      const LatticePoint x{Integer(number(900)), Integer(number(900)), Integer(number(900))};
      const Integer h = dot(plane.n, x);
      CHECK(covers(in, x) == (h <= plane.d));
      CHECK(covers(out, x) == (h >= plane.d));
    }
    const auto outward = [](const Slab& s) {
      return dot(cross(minus(s.corners[1], s.corners[0]), minus(s.corners[3], s.corners[0])), minus(s.corners[0], s.corners[4])).sign() > 0;
    };
    CHECK(in.outward == outward(in));
    CHECK(out.outward == outward(out));
  }
}

TEST_CASE("The model scales every offset to an integer and keeps the shape", "[validation]") {
  // x <= 1/3 in a frame of quarter units far from the origin.
  PlaneBody body = samples::simple_body({{-3, 0, 0, -1000000}, {3, 0, 0, 1000001}, {0, -1, 0, 1}, {0, 1, 0, 1}, {0, 0, -1, 1}, {0, 0, 1, 1}});
  body.scale = -2;
  const ScadModel model = scad_model(body);
  CHECK(model.representable());
  CHECK(model.fraction_bits == 0);
  CHECK(model.corner_bits <= 32);
  // Lengths along x and y: 1/12 and 1/2 file units.
  Rational width;
  for (const auto& p : model.vertices) {
    for (const auto& q : model.vertices) width = std::max(width, p.x - q.x);
  }
  CHECK(width * model.unit == Rational(Integer(1), Integer(12)));
}

TEST_CASE("What OpenSCAD cannot hold is refused", "[validation]") {
  const long long big = 1LL << 58;
  const PlaneBody body = samples::simple_body({{-1, 0, 0, 1}, {0, -1, 0, 1}, {0, 0, -1, 1}, {big + 1, big - 3, big + 9, big}});
  CHECK_FALSE(scad_model(body).representable());
  CHECK_THROWS_AS(corner_cutting_program(body), ResourceLimit);
  PlaneBody golden;
  golden.field = Field::sqrt5;
  CHECK_THROWS_AS(scad_model(golden), InvalidInput);
}

TEST_CASE("A body that is not convex is refused with vertex and plane", "[validation]") {
  PlaneBody body = samples::cube();
  Plane<Integer> p = body.planes[0];
  body.planes.push_back({p.a + p.a, Integer(1), Integer(0), Integer(1)});  // cuts corners that the loops keep
  body.addresses.push_back({});
  body.loops.close_loop();
  try {
    (void)scad_model(body);
    FAIL("accepted");
  } catch (const InvalidInput& e) {
    CHECK(e.code() == "NotConvex");
  }
}

TEST_CASE("Programs hold one solid for each half-space", "[validation]") {
  const std::string program = corner_cutting_program(samples::honeycomb(samples::cube(), 1));
  std::size_t count = 0;
  for (std::size_t at = 0; (at = program.find("polyhedron(", at)) != std::string::npos; ++at) ++count;
  CHECK(count == 14);
  CHECK(program.find("intersection() {") != std::string::npos);
}
