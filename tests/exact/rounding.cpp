// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/rounding.hpp"

#include "hexact/exact/mesh_difference.hpp"
#include "hexact/io/mesh_file.hpp"
#include "hexact/kernel/errors.hpp"
#include "solid_samples.hpp"

#include <catch2/catch.hpp>

#include <cfloat>
#include <cmath>
#include <random>

using namespace hexact;

namespace {

/// The definition: no float is nearer, and at equal distance the even one is taken.
bool is_nearest(const Rational& x, float f) {
  const auto distance = [&](float g) { return abs(x - Rational::from_double(static_cast<double>(g))); };
  for (const float g : {std::nextafter(f, -FLT_MAX), std::nextafter(f, FLT_MAX)}) {
    if (g == f) continue;
    const auto order = distance(g) <=> distance(f);
    if (order < 0) return false;
    if (order == 0 && (std::bit_cast<std::uint32_t>(f) & 1) != 0) return false;
  }
  return true;
}

Rational half_way(float f) {
  const double g = static_cast<double>(std::nextafter(f, FLT_MAX));
  return (Rational::from_double(static_cast<double>(f)) + Rational::from_double(g)).scaled(-1);
}

}  // namespace

TEST_CASE("rounding to float32 is not misled by rounding to double first", "[rounding]") {
  std::mt19937_64 random(11);
  std::vector<float> floats = {0.0f, FLT_TRUE_MIN, FLT_MIN, 1.0f, 1 / 3.0f, std::nextafter(FLT_MIN, 0.0f), 16777215.0f, 1e30f};
  for (int i = 0; i < 200; ++i) floats.push_back(std::bit_cast<float>(static_cast<std::uint32_t>(random() % 0x7f000000u)));
  int misled = 0;
  for (const float f : floats) {
    const Rational middle = half_way(f);
    REQUIRE(is_float_midpoint(middle.to_double()));
    for (const long depth : {54, 60, 100, 300}) {
      for (const int side : {-1, 0, 1}) {
        const Rational x = middle + (middle * Rational(side)).scaled(-depth);
        const float rounded = nearest_float(x);
        CHECK(is_nearest(x, rounded));
        CHECK(nearest_float(-x) == -rounded);
        CHECK(nearest_float(QuadraticField(x)) == rounded);
        if (static_cast<float>(x.to_double()) != rounded) ++misled;
      }
    }
  }
  CHECK(misled > 500);  // the cases that two roundings get wrong are among them
  CHECK_FALSE(is_float_midpoint(1.0));
  CHECK_FALSE(is_float_midpoint(1.1));
  CHECK_FALSE(is_float_midpoint(0.0));
  CHECK(is_float_midpoint(0x1p-150));
}

TEST_CASE("the largest float and what is beyond", "[rounding]") {
  const Rational edge = Rational::from_double(0x1.ffffffp127);  // halfway to 2^128
  CHECK(nearest_float(edge - Rational(1).scaled(-50)) == FLT_MAX);
  CHECK(std::isinf(nearest_float(edge)));
  CHECK(std::isinf(nearest_float(Rational::from_double(DBL_MAX))));
  const std::vector<Point3<Rational>> far = {{edge, Rational(0), Rational(0)}};
  CHECK_THROWS_AS(rounded_points(far, FloatFormat::binary32), ResourceLimit);
  CHECK(rounded_points(far, FloatFormat::binary64).max_rounding == 0);
}

TEST_CASE("vertices of a body: float32 by the filter and exactly agree, within the bound", "[rounding]") {
  const PlaneBody body = samples::honeycomb(samples::generic_dodecahedron(), 3);
  const RoundedVertices rounded = rounded_vertices(body, FloatFormat::binary32);
  std::vector<Point3<Rational>> exact;
  for (std::size_t v = 0; v < body.vertex_count(); ++v) exact.push_back(rational_vertex(body, make_id<VertexId>(v)));
  CHECK(rounded_points(exact, FloatFormat::binary32).points == rounded.points);
  const Rational bound = Rational::from_double(rounded.max_rounding);
  Rational largest(0);
  for (std::size_t v = 0; v < exact.size(); ++v) {
    CHECK(is_nearest(exact[v].x, static_cast<float>(rounded.points[v].x)));
    const auto square = [](const Rational& x, double y) {
      const Rational d = x - Rational::from_double(y);
      return d * d;
    };
    const Rational d = square(exact[v].x, rounded.points[v].x) + square(exact[v].y, rounded.points[v].y) +
                       square(exact[v].z, rounded.points[v].z);
    CHECK(d <= bound * bound);
    largest = std::max(largest, d);
  }
  CHECK(Rational::from_double(std::sqrt(largest.to_double())) * Rational::from_double(1 + 1e-9) >= bound);
}

TEST_CASE("a coordinate halfway between two floats but for 2^-60 is rounded by its last bits", "[rounding]") {
  // Planes x = ±(1 + 2^-24 ± 2^-60): the double nearest to them is the midpoint, whose even float is 1.
  for (const int sign : {-1, 1}) {
    PlaneBody cube = samples::cube();
    const Integer one = Integer(1).shifted_left(60);
    cube.planes.set(1, Plane<Integer>{one, Integer(0), Integer(0), one + Integer(1).shifted_left(36) + Integer(sign)});
    const float expected = sign > 0 ? 1 + 0x1p-23f : 1.0f;
    double largest = 0;
    for (const auto& p : rounded_vertices(cube, FloatFormat::binary32).points) largest = std::max(largest, p.x);
    CHECK(largest == static_cast<double>(expected));
  }
}

TEST_CASE("float32 files are compared with the nearest float32, triangles of STL with the fans", "[rounding]") {
  const PlaneBody body = samples::honeycomb(samples::tetrahedron(), 3);
  using io::Format;
  for (const Format format : {Format::stl, Format::stl_ascii, Format::ply_float, Format::ply, Format::obj}) {
    const RoundedVertices rounded = rounded_vertices(body, io::coordinate_format(format));
    const io::MeshView view{rounded.points, body.loops, body.addresses};
    const auto read = [&](const io::MeshView& mesh) {
      return std::get<PolygonSoup<Rational>>(io::parse_geometry(io::mesh_text(format, mesh), format, "test"));
    };
    CAPTURE(static_cast<int>(format));
    CHECK(mesh_difference(body, read(view)).empty());
    // One unit in the last place of any coordinate, another order and a lost facet are found.
    const auto step = [&](double x) {
      if (io::coordinate_format(format) == FloatFormat::binary64) return std::nextafter(x, 100.0);
      return static_cast<double>(std::nextafter(static_cast<float>(x), 100.0f));
    };
    for (std::size_t v = 0; v < rounded.points.size(); v += 7) {
      for (int k = 0; k < 3; ++k) {
        std::vector<Point3<double>> points = rounded.points;
        double& x = k == 0 ? points[v].x : k == 1 ? points[v].y : points[v].z;
        x = step(x);
        CHECK_FALSE(mesh_difference(body, read({points, body.loops, body.addresses})).empty());
      }
    }
    FacetLoops fewer;
    for (std::size_t f = 0; f + 1 < body.loops.size(); ++f) fewer.add(std::vector<VertexId>(body.loops[f].begin(), body.loops[f].end()));
    CHECK_FALSE(mesh_difference(body, read({rounded.points, fewer, {}})).empty());
  }
  // Text that spells floats is no file of floats.
  const RoundedVertices floats = rounded_vertices(body, FloatFormat::binary32);
  const auto text = io::mesh_text(Format::obj, {floats.points, body.loops, body.addresses});
  CHECK_FALSE(mesh_difference(body, std::get<PolygonSoup<Rational>>(io::parse_geometry(text, Format::obj, "test"))).empty());
}
