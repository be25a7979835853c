// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/io/mesh_file.hpp"

#include "hexact/exact/rounded_attributes.hpp"
#include "hexact/kernel/errors.hpp"

#include <catch2/catch.hpp>

#include <bit>
#include <cfloat>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

using namespace hexact;
using io::Format;

namespace {

struct Mesh {
  std::vector<Point3<double>> points;
  FacetLoops facets;
  std::vector<FacetAddress> addresses;
  [[nodiscard]] io::MeshView view() const { return {points, facets, addresses}; }
};

void add_facet(FacetLoops& loops, std::initializer_list<std::uint32_t> corners) {
  for (const std::uint32_t corner : corners) loops.add_corner(VertexId{corner});
  loops.close_loop();
}

/// Facets of a cube with corners of arbitrary position: only numbers are tested.
Mesh odd_mesh() {
  Mesh mesh;
  std::mt19937_64 random(7);
  for (int i = 0; i < 8; ++i) {
    const auto number = [&] {
      while (true) {
        const double x = std::bit_cast<double>(random());
        if (std::isfinite(x)) return x;
      }
    };
    mesh.points.push_back({number(), number(), number()});
  }
  mesh.points[0] = {DBL_MAX, DBL_TRUE_MIN, -DBL_MIN};
  mesh.points[1] = {0.1, 1e22, 5e-324};
  add_facet(mesh.facets, {0, 3, 2, 1});
  add_facet(mesh.facets, {4, 5, 6, 7});
  add_facet(mesh.facets, {0, 1, 5, 4});
  add_facet(mesh.facets, {1, 2, 6, 5});
  add_facet(mesh.facets, {2, 3, 7, 6, 0});
  add_facet(mesh.facets, {3, 0, 4});
  for (std::uint32_t f = 0; f < 6; ++f) {
    mesh.addresses.push_back({f, f == 0 ? std::nullopt : std::optional(VertexId{10 * f})});
  }
  return mesh;
}

PolygonSoup<Rational> soup(Format format, std::string_view text) {
  return std::get<PolygonSoup<Rational>>(io::parse_geometry(text, format, "test"));
}
PlaneBody body(std::string_view text) { return std::get<PlaneBody>(io::parse_geometry(text, Format::planes, "test")); }

/// What the parser says about a malformed text.
struct Place {
  std::uint64_t line;
  std::string element;
  bool operator==(const Place&) const = default;
};
std::ostream& operator<<(std::ostream& out, const Place& p) { return out << p.line << " '" << p.element << "'"; }

Place error_of(Format format, const std::string& text) {
  try {
    (void)io::parse_geometry(text, format, "test");
  } catch (const ParseError& e) {
    CHECK(e.file() == "test");
    return {e.line().value_or(0), e.element()};
  }
  FAIL("accepted: " << text);
  return {};
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  REQUIRE(at != std::string::npos);
  return text.replace(at, from.size(), to);
}

const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
const std::string kOff = "OFF\n4 4 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty float y\nproperty int z\n"
    "element face 4\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const std::string kPlanes =
    "hexact-planes 1\nfield Q\nscale 0\nplanes 4\n0 0 -1 0 0 -\n0 -1 0 0 0 -\n1 1 1 1 0 -\n-1 0 0 0 1 7\n"
    "loops 4\n3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n";
const std::string kStl =
    "solid t\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid t\n";

}  // namespace

TEST_CASE("doubles survive every mesh format bit for bit", "[io]") {
  const Mesh mesh = odd_mesh();
  const Format format = GENERATE(Format::obj, Format::off, Format::ply, Format::ply_ascii);
  const auto read = soup(format, io::mesh_text(format, mesh.view(), {}));
  REQUIRE(read.points.size() == mesh.points.size());
  for (std::size_t v = 0; v < read.points.size(); ++v) {
    CHECK(read.points[v].x.to_double() == mesh.points[v].x);
    CHECK(read.points[v].y.to_double() == mesh.points[v].y);
    CHECK(read.points[v].z.to_double() == mesh.points[v].z);
  }
  CHECK(read.facets == mesh.facets);
  if (format != Format::off) CHECK(read.addresses == mesh.addresses);
}

TEST_CASE("STL merges equal corners and is a fan of float triangles", "[io]") {
  Mesh mesh = odd_mesh();
  for (std::size_t v = 0; v < 8; ++v) mesh.points[v] = {static_cast<double>(v) + 0.1, v % 2 + 0.0, v % 3 + 0.0};
  const auto binary = soup(Format::stl, io::mesh_text(Format::stl, mesh.view(), {}));
  CHECK(binary.points.size() == 8);
  CHECK(binary.facets.size() == 12);
  CHECK(binary.points[0].x == Rational::from_double(static_cast<double>(static_cast<float>(0.1))));
  const auto text = soup(Format::stl, io::mesh_text(Format::stl_ascii, mesh.view(), {}));
  CHECK(text.facets == binary.facets);
  CHECK(text.points[0].x == Rational(1) / Rational(10));
  mesh.points[0].x = 1e39;
  CHECK_THROWS_AS(io::mesh_text(Format::stl, mesh.view(), {}), InvalidInput);
}

TEST_CASE("text numbers are the decimals they spell", "[io]") {
  const auto read = soup(Format::obj, replaced(kObj, "v 1 0 0", "v 0.1 -2.5e-3 123456789012345678901234567890"));
  CHECK(read.points[1].x == Rational(1) / Rational(10));
  CHECK(read.points[1].y == Rational(-1) / Rational(400));
  CHECK(read.points[1].z.str() == "123456789012345678901234567890");
  CHECK(soup(Format::obj, replaced(kObj, "v 1 0 0", "v 1e308 0 0")).points[1].x.to_double() == 1e308);
}

TEST_CASE("OBJ: relative indices, texture and normal indices, groups", "[io]") {
  const auto plain = soup(Format::obj, kObj);
  CHECK(plain.facets == soup(Format::obj, replaced(kObj, "f 1 2 4", "f -4//1 -3/1/1 -1/2")).facets);
  CHECK(plain.facets == soup(Format::obj, replaced(kObj, "f 1 2 4", "f 1 \\\n 2 4 # comment")).facets);
  CHECK(plain.addresses.empty());
  const auto grouped = soup(Format::obj, replaced(kObj, "f 1 3 2", "g f2_5\nf 1 3 2\ng f0_-"));
  REQUIRE(grouped.addresses.size() == 4);
  CHECK(grouped.addresses[0] == FacetAddress{2, VertexId{5}});
  CHECK(grouped.addresses[3] == FacetAddress{0, std::nullopt});
}

TEST_CASE("OBJ: texture coordinates, groups, materials and addresses are read and written", "[io]") {
  const std::string text =
      "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nvt 0 0\nvt 0.1 1\nvt 1 0.5\n"
      "f 2 3 4\nusemtl brick wall\ng south side f3_7\nf 1/1 3/2 2/3\nf 1/1/9 2/-1/9 4/2\ng\nusemtl glass\nf 1 4 3\n";
  const auto read = soup(Format::obj, text);
  const auto& a = read.attributes;
  CHECK(a.texture_size == 2);
  CHECK(a.texture.values.size() == 3);
  CHECK(a.texture.values[1] == Point3<Rational>{Rational(1) / Rational(10), 1, 0});
  CHECK(a.texture.of_corner == std::vector<std::uint32_t>{kNothing, kNothing, kNothing, 0, 1, 2, 0, 2, 1, kNothing, kNothing, kNothing});
  CHECK(a.groups.names == std::vector<std::string>{"south side"});
  CHECK(a.groups.of_facet == std::vector<std::uint32_t>{kNothing, 0, 0, kNothing});
  CHECK(a.materials.names == std::vector<std::string>{"brick wall", "glass"});
  CHECK(a.materials.of_facet == std::vector<std::uint32_t>{kNothing, 0, 0, 1});
  CHECK(a.material_libraries == std::vector<std::string>{"a.mtl"});
  CHECK(read.addresses.empty());  // only two facets have one

  const MeshAttributes<double> attributes = rounded_attributes(a);
  const std::vector<Point3<double>> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const std::vector<FacetAddress>& addresses :
       {std::vector<FacetAddress>{}, {{0, {}}, {3, VertexId{7}}, {3, VertexId{8}}, {0, {}}}}) {
    const auto again = soup(Format::obj, io::mesh_text(Format::obj, {points, read.facets, addresses, &attributes}, {}));
    CHECK(again.attributes.groups == a.groups);
    CHECK(again.attributes.materials == a.materials);
    CHECK(again.attributes.material_libraries == a.material_libraries);
    CHECK(rounded_attributes(again.attributes) == attributes);
    CHECK(again.addresses == addresses);
    CHECK(again.facets == read.facets);
  }
  // Texture numbers count only where there are texture coordinates.
  CHECK(soup(Format::obj, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1/7 2 3/-2\n").attributes.empty());
  CHECK(error_of(Format::obj, replaced(text, "3/2 2/3", "3/4 2/3")) == Place{12, "facet 1"});
  CHECK(error_of(Format::obj, replaced(text, "3/2 2/3", "3/-4 2/3")) == Place{12, "facet 1"});
  CHECK(error_of(Format::obj, replaced(text, "3/2 2/3", "3 2/3")) == Place{12, "facet 1"});
  CHECK(error_of(Format::obj, replaced(text, "vt 0.1 1", "vt 0.1 nan")) == Place{7, "texture coordinate 1"});
  CHECK(error_of(Format::obj, replaced(text, "vt 0.1 1", "vt 0.1 1 2 3")) == Place{7, "texture coordinate 1"});
}

TEST_CASE("PLY: texture coordinates of corners and of vertices", "[io]") {
  FacetLoops facets;
  add_facet(facets, {0, 1, 2});
  add_facet(facets, {0, 2, 3});
  add_facet(facets, {0, 3, 1});
  const std::vector<Point3<double>> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const std::vector<FacetAddress> addresses{{1, VertexId{3}}, {0, {}}, {0, {}}};
  MeshAttributes<double> attributes;
  attributes.texture = {{{0.1, 0.25, 0}, {1, 0, 0}, {0, 5e-324, 0}, {0.1, 0.25, 0}, {-1, 0, 0}, {7, 8, 0}},
                        {0, 1, 2, kNothing, kNothing, kNothing, 3, 4, 5}};
  for (const Format format : {Format::ply, Format::ply_ascii}) {
    const auto again = soup(format, io::mesh_text(format, {points, facets, addresses, &attributes}, {}));
    CHECK(rounded_attributes(again.attributes) == attributes);
    CHECK(again.facets == facets);
    CHECK(again.addresses == addresses);
    CHECK(soup(format, io::mesh_text(format, {points, facets, addresses}, {})).attributes.empty());
  }
  const std::string text = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                           "property float s\nproperty float t\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                           "0 0 0 0.5 1\n1 0 0 0.5 2\n0 1 0 0.5 3\n3 2 0 1\n";
  const auto vertices = soup(Format::ply, text).attributes.texture;
  CHECK(vertices.of_corner == std::vector<std::uint32_t>{2, 0, 1});
  CHECK(vertices.values[2] == Point3<Rational>{Rational(1) / Rational(2), 3, 0});
  const std::string lists = replaced(text, "end_header", "property list uchar float texcoord\nend_header");
  CHECK(soup(Format::ply, replaced(lists, "3 2 0 1\n", "3 2 0 1 6 1 2 3 4 5 6\n")).attributes.texture.values[2] == Point3<Rational>{5, 6, 0});
  CHECK(error_of(Format::ply, replaced(lists, "3 2 0 1\n", "3 2 0 1 5 1 2 3 4 5\n")).element == "facet 0");
  CHECK(error_of(Format::ply, replaced(lists, "3 2 0 1\n", "3 2 0 1 4 1 2 3 4\n")).element == "facet 0");
  CHECK(error_of(Format::ply, replaced(lists, "3 2 0 1\n", "3 2 0 1 6 1 2 3 4 nan 6\n")).element == "facet 0");
}

TEST_CASE("texture coordinates that are no numbers are not written", "[io]") {
  FacetLoops facets;
  add_facet(facets, {0, 1, 2});
  const std::vector<Point3<double>> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  MeshAttributes<double> attributes;
  attributes.texture = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {0, 1, 2}};
  for (const Format format : {Format::obj, Format::ply, Format::ply_ascii}) {
    CHECK_NOTHROW(io::mesh_text(format, {points, facets, {}, &attributes}, {}));
    for (const double bad : {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
      MeshAttributes<double> broken = attributes;
      broken.texture.values[1].y = bad;
      try {
        (void)io::mesh_text(format, {points, facets, {}, &broken}, {});
        FAIL("written");
      } catch (const InvalidInput& refusal) {
        CHECK(std::string(refusal.what()).find("texture coordinate 1") != std::string::npos);
      }
    }
  }
}

TEST_CASE("OFF: further columns, comments, colours", "[io]") {
  const auto plain = soup(Format::off, kOff);
  CHECK(plain.facets.size() == 4);
  const auto coloured = soup(Format::off,
                             "COFF # c\n# note\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0 0 0\n0 1 0 1 1 1 1\n3 0 1 2 255 0 0\n");
  CHECK(coloured.points.size() == 3);
  CHECK(soup(Format::off, "NOFF\n3 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n").points.size() == 3);
}

TEST_CASE("a malformed file names line and element", "[io]") {
  struct Case {
    Format format;
    std::string text;
    Place place;
  };
  const Case cases[] = {
      {Format::obj, replaced(kObj, "v 1 0 0", "v 1 x 0"), {2, "vertex 1"}},
      {Format::obj, replaced(kObj, "v 1 0 0", "v 1 nan 0"), {2, "vertex 1"}},
      {Format::obj, replaced(kObj, "v 1 0 0", "v 1 0"), {2, "vertex 1"}},
      {Format::obj, replaced(kObj, "v 1 0 0", "v 1e309 0 0"), {2, "vertex 1"}},
      {Format::obj, replaced(kObj, "v 1 0 0", "v 1e999999999 0 0"), {2, "vertex 1"}},
      {Format::obj, replaced(kObj, "v 1 0 0", "v " + std::string(400, '9') + " 0 0"), {2, "vertex 1"}},
      {Format::obj, replaced(kObj, "f 1 2 4", "f 1 2 5"), {6, "facet 1"}},
      {Format::obj, replaced(kObj, "f 1 2 4", "f 1 2 0"), {6, "facet 1"}},
      {Format::obj, replaced(kObj, "f 1 2 4", "f 1 2 -5"), {6, "facet 1"}},
      {Format::obj, replaced(kObj, "f 1 2 4", "f 1 2"), {6, "facet 1"}},
      {Format::obj, replaced(kObj, "f 1 2 4", "f 1 2 4/"), {6, "facet 1"}},
      {Format::obj, std::string("\0\1\2\3", 4), {1, ""}},
      {Format::off, "OFF\n4000000000 1 1\n", {2, ""}},
      {Format::off, replaced(kOff, "4 4 0", "4 5 0"), {11, "facet 4"}},
      {Format::off, replaced(kOff, "4 4 0", "4 3 0"), {10, ""}},
      {Format::off, replaced(kOff, "3 0 1 3", "3 0 1 4"), {8, "facet 1"}},
      {Format::off, replaced(kOff, "3 0 1 3", "2 0 1"), {8, "facet 1"}},
      {Format::off, replaced(kOff, "3 0 1 3", "3 0 1"), {8, "facet 1"}},
      {Format::off, replaced(kOff, "1 0 0\n", "1 0 0 0\n"), {4, "vertex 1"}},
      {Format::off, replaced(kOff, "OFF", "4OFF"), {1, ""}},
      {Format::ply, replaced(kPly, "face 4", "face 4000000"), {7, ""}},
      {Format::ply, replaced(kPly, "uchar int", "float int"), {8, ""}},
      {Format::ply, replaced(kPly, "property int z\n", ""), {3, ""}},
      {Format::ply, replaced(kPly, "3 0 1 3", "3 0 1 4"), {15, "facet 1"}},
      {Format::ply, replaced(kPly, "1 0 0\n", "inf 0 0\n"), {11, "vertex 1"}},
      {Format::ply, kPly + "1\n", {18, ""}},
      {Format::stl, replaced(kStl, "vertex 1 0 0", "vertex 1 0"), {5, "facet 0"}},
      {Format::stl, replaced(kStl, "endloop", "vertex 1 1 1"), {7, "facet 0"}},
      {Format::stl, kStl.substr(0, 60), {5, "facet 0"}},
      {Format::stl, std::string(84, '\x7f'), {1, ""}},
      {Format::planes, replaced(kPlanes, "planes 4", "planes 4000000000"), {4, ""}},
      {Format::planes, replaced(kPlanes, "1 1 1 1 0 -", "1 1 1 1/0 0 -"), {7, "plane 2"}},
      {Format::planes, replaced(kPlanes, "1 1 1 1 0 -", "0 0 0 1 0 -"), {7, "plane 2"}},
      {Format::planes, replaced(kPlanes, "1 1 1 1 0 -", "1 1 1 1.5 0 -"), {7, "plane 2"}},
      {Format::planes, replaced(kPlanes, "1 1 1 1 0 -", "1 1 1 1 0"), {7, "plane 2"}},
      {Format::planes, replaced(kPlanes, "scale 0", "scale 0\nshift 1/3 0 0"), {4, ""}},
      {Format::planes, replaced(kPlanes, "scale 0", "scale 1000000000"), {3, ""}},
      {Format::planes, replaced(kPlanes, "loops 4", "loops 3"), {9, ""}},
      {Format::planes, replaced(kPlanes, "3 0 1 3", "2 0 1"), {11, "facet 1"}},
      {Format::planes, replaced(kPlanes, "3 0 1 3", "3 0 1 4294967000"), {11, "facet 1"}},
      {Format::planes, replaced(kPlanes, "3 0 1 3", "0"), {14, "vertex 0"}},
      {Format::planes, kPlanes + "vertices 3\n0 1 2\n0 1 2\n0 1 2\n", {11, "facet 1"}},
      {Format::planes, kPlanes + "vertices 4\n0 1 2\n0 1 4\n0 1 2\n0 1 2\n", {16, "vertex 1"}},
      {Format::planes, kPlanes + "rest\n", {14, ""}},
      {Format::obj, "", {1, ""}},
  };
  for (const Case& c : cases) {
    INFO(c.text);
    CHECK(error_of(c.format, c.text) == c.place);
  }
}

TEST_CASE("binary PLY and STL: truncation, huge lists, big endian", "[io]") {
  const Mesh mesh = odd_mesh();
  const std::string ply = io::mesh_text(Format::ply, mesh.view(), {});
  for (std::size_t cut = 1; cut < 60; ++cut) {
    CHECK_THROWS_AS(io::parse_geometry(ply.substr(0, ply.size() - cut), Format::ply, "test"), ParseError);
  }
  CHECK_THROWS_AS(io::parse_geometry(ply + "x", Format::ply, "test"), ParseError);
  const std::string header =
      "ply\nformat binary_big_endian 1.0\nelement vertex 3\nproperty short x\nproperty uchar y\nproperty char z\n"
      "element face 1\nproperty list uint ushort vertex_index\nend_header\n";
  const std::string points("\x01\x02\x00\x00\xff\xfe\x05\xff\x00\x00\x00\x01", 12);
  const auto read = soup(Format::ply, header + points + std::string("\0\0\0\3\0\0\0\1\0\2", 10));
  CHECK(read.points[0].x == Rational(258));
  CHECK(read.points[1].x == Rational(-2));
  CHECK(read.points[1].z == Rational(-1));
  CHECK(error_of(Format::ply, header + points + std::string("\xff\xff\xff\xff\0\0\0\1\0\2", 10)) == Place{0, "facet 0"});
  std::string stl(84, '\0');
  stl[83] = '\x7f';
  CHECK(error_of(Format::stl, stl) == Place{1, ""});
}

TEST_CASE(".planes round trip, byte for byte", "[io]") {
  CHECK(io::planes_text(body(kPlanes)) == kPlanes);
  const std::string scaled = replaced(kPlanes, "scale 0", "scale -7\nshift 1/4 0 -3");
  CHECK(io::planes_text(body(scaled)) == scaled);
  const std::string big = replaced(kPlanes, "1 1 1 1 0 -", "1 1 1 123456789012345678901234567890 0 -");
  CHECK(io::planes_text(body(big)) == big);
  const std::string golden = replaced(replaced(kPlanes, "field Q", "field Q(sqrt5)"), "1 1 1 1 0 -", "1/2+-3/2*sqrt5 1 1 1 0 -");
  const PlaneBody sqrt5 = body(replaced(golden, "+-", "-"));
  CHECK(sqrt5.planes_sqrt5[2].a == QuadraticField(Rational(1) / Rational(2), Rational(-3) / Rational(2)));
  const std::string again = io::planes_text(sqrt5);
  CHECK(io::planes_text(body(again)) == again);
  CHECK(body(again).planes_sqrt5 == sqrt5.planes_sqrt5);
}

TEST_CASE("fractions in planes are cleared by a positive factor", "[io]") {
  const PlaneBody read = body(replaced(kPlanes, "1 1 1 1 0 -", "1/2 -1/3 1 5/6 0 -"));
  CHECK(read.planes.narrow(2) == IntegerPlanes::Narrow{3, -2, 6, 5});
}

TEST_CASE("triples are derived counter-clockwise from the smallest facet, or read", "[io]") {
  const PlaneBody read = body(kPlanes);
  REQUIRE(read.vertex_count() == 4);
  // At vertex 0 facet 0 (0 2 1) arrives from 1, and facet 1 (0 1 3) leaves towards 1.
  CHECK(read.triples[0] == std::array<FacetId, 3>{FacetId{0}, FacetId{1}, FacetId{3}});
  const std::string explicit_text = kPlanes + "vertices 4\n0 1 3\n0 1 2\n0 2 3\n1 2 3\n";
  CHECK(body(explicit_text).triples.size() == 4);
  CHECK(body("# c\n" + replaced(kPlanes, "field", "\n#\nfield")).triples == read.triples);
}

TEST_CASE("certificates round trip and every changed byte is rejected", "[io]") {
  Certificate certificate;
  certificate.body = body(kPlanes);
  certificate.claims = {{"convex", ""}, {"inside", "base"}};
  certificate.bodies.push_back({"base", body(kPlanes)});
  certificate.supports.push_back({"base", 2, VertexId{1}});
  certificate.provenance = {"made by a test"};
  const std::string text = io::certificate_text(certificate);
  const auto read = std::get<Certificate>(io::parse_geometry(text, Format::certificate, "test"));
  CHECK(read.claims == certificate.claims);
  CHECK(read.provenance == certificate.provenance);
  CHECK(io::certificate_text(read) == text);
  for (std::size_t i = 0; i + 1 < text.size(); ++i) {
    std::string edited = text;
    edited[i] = static_cast<char>(edited[i] ^ 1);
    CHECK_THROWS_AS(io::parse_geometry(edited, Format::certificate, "test"), ParseError);
  }
  const std::string unknown = replaced(text.substr(0, text.rfind("sha256")), "inside=base", "inside=other");
  CHECK(error_of(Format::certificate, unknown + "sha256 " + io::sha256_hex(unknown) + "\n").element == "claim 1");
}

TEST_CASE("SHA-256 of the examples of FIPS 180", "[io]") {
  CHECK(io::sha256_hex("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(io::sha256_hex("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(io::sha256_hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
}

TEST_CASE("formats by name and ending", "[io]") {
  CHECK(io::format_from_path("a/b.PLY") == Format::ply);
  CHECK(io::format_from_path("x.hxc") == Format::certificate);
  CHECK(!io::format_from_path("a.obj/b"));
  CHECK(io::format_from_name("stl-ascii") == Format::stl_ascii);
  CHECK(!io::format_from_name("step"));
}

TEST_CASE("OpenSCAD faces are clockwise from outside", "[io]") {
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 0.1, 0}};
  add_facet(mesh.facets, {0, 1, 2});
  const std::string text = io::mesh_text(Format::scad, mesh.view(), {});
  CHECK(text.find("[2, 1, 0]") != std::string::npos);
  CHECK(text.find("0.10000000000000001") != std::string::npos);
}

TEST_CASE("a comment that ends in several carriage returns is written as it was read", "[io]") {
  std::ifstream in(HEXACT_TEST_DATA "/../fuzz/corpus/certificate/prism.txt", std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  bytes = bytes.substr(0, bytes.rfind("sha256 ") == std::string::npos ? bytes.size() : bytes.rfind("sha256 "));
  bytes.insert(bytes.find('\n') + 1, "# made by hand\r\r\r\n");
  bytes += "sha256 " + io::sha256_hex(bytes) + "\n";
  const auto certificate = std::get<Certificate>(io::parse_geometry(bytes, io::Format::certificate, "test"));
  const std::string text = io::certificate_text(certificate);
  CHECK(io::certificate_text(std::get<Certificate>(io::parse_geometry(text, io::Format::certificate, "test"))) == text);
}
