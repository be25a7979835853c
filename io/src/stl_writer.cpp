// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mesh_writers.hpp"
#include "number_text.hpp"

#include "hexact/kernel/errors.hpp"

#include <bit>
#include <cmath>

namespace hexact::io {
namespace {

using Triangle = std::array<Point3<double>, 3>;

/// Calls `use` with every triangle of the fans from the facets' first corners.
template <class Use>
void for_each_triangle(const MeshView& mesh, Use use) {
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const auto loop = mesh.facets[f];
    for (std::size_t i = 2; i < loop.size(); ++i) {
      use(Triangle{mesh.points[index(loop[0])], mesh.points[index(loop[i - 1])], mesh.points[index(loop[i])]}, f);
    }
  }
}

/// Unit normal, or zero where the triangle has none; readers may not rely on it.
Point3<double> normal(const Triangle& t) {
  const double ux = t[1].x - t[0].x, uy = t[1].y - t[0].y, uz = t[1].z - t[0].z;
  const double vx = t[2].x - t[0].x, vy = t[2].y - t[0].y, vz = t[2].z - t[0].z;
  const double x = uy * vz - uz * vy, y = uz * vx - ux * vz, z = ux * vy - uy * vx;
  const double length = std::hypot(x, y, z);
  if (!(length > 0) || !std::isfinite(length)) return {};
  return {x / length, y / length, z / length};
}

void append_float(std::string& text, double value, std::size_t facet) {
  const auto bits = std::bit_cast<std::uint32_t>(narrowed(value, "facet", facet));
  for (int i = 0; i < 4; ++i) text.push_back(static_cast<char>(bits >> (8 * i) & 0xff));
}

void append_floats(std::string& text, const Point3<double>& p, std::size_t facet) {
  for (const double value : {p.x, p.y, p.z}) append_float(text, value, facet);
}

std::string& append_words(std::string& text, const Point3<double>& p) {
  append_double(text, p.x).push_back(' ');
  append_double(text, p.y).push_back(' ');
  append_double(text, p.z).push_back('\n');
  return text;
}

}  // namespace

std::string stl_text(const MeshView& mesh) {
  std::string text = "hexact";
  text.resize(84);
  std::uint64_t triangles = 0;
  for_each_triangle(mesh, [&](const Triangle& t, std::size_t f) {
    append_floats(text, normal(t), f);
    for (const auto& p : t) append_floats(text, p, f);
    text.append(2, '\0');
    ++triangles;
  });
  if (triangles > 0xffffffffu) throw InvalidInput("NotRepresentable", "more triangles than the format can count", "");
  for (std::size_t i = 0; i < 4; ++i) text[80 + i] = static_cast<char>(triangles >> (8 * i) & 0xff);
  return text;
}

std::string stl_ascii_text(const MeshView& mesh) {
  std::string text = "solid hexact\n";
  for_each_triangle(mesh, [&](const Triangle& t, std::size_t) {
    append_words(text += "facet normal ", normal(t));
    text += "outer loop\n";
    for (const auto& p : t) append_words(text += "vertex ", p);
    text += "endloop\nendfacet\n";
  });
  return text += "endsolid hexact\n";
}

}  // namespace hexact::io
