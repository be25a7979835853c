// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mesh_writers.hpp"
#include "number_text.hpp"

#include "hexact/kernel/errors.hpp"

#include <algorithm>
#include <cmath>

namespace hexact::io {
namespace {

std::string& append_point(std::string& text, const Point3<double>& p) {
  append_double(text, p.x).push_back(' ');
  append_double(text, p.y).push_back(' ');
  return append_double(text, p.z);
}

std::size_t facet_count(const MeshView& mesh) {
  std::size_t facets = 0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) facets += mesh.facets[f].empty() ? 0 : 1;
  return facets;
}

std::string unit_comment(const MeshWriteOptions& options) {
  return options.unit.empty() ? std::string() : "# unit " + options.unit + "\n";
}

void append_17_digits(std::string& text, double value) {
  char buffer[40];
  const auto result = std::to_chars(buffer, buffer + sizeof(buffer), value, std::chars_format::general, 17);
  text.append(buffer, result.ptr);
}

}  // namespace

namespace {

/// The names of facets as an OBJ file has them: statements that hold until the next one.
class ObjNames {
 public:
  explicit ObjNames(const MeshView& mesh) : mesh_(mesh) {}

  /// The statements that have to stand before facet f.
  void append(std::string& text, std::size_t f) {
    const FacetNames none, &groups = mesh_.attributes != nullptr ? mesh_.attributes->groups : none;
    const FacetNames& materials = mesh_.attributes != nullptr ? mesh_.attributes->materials : none;
    const std::string* material = name(materials, f);
    if (material != material_) text += "usemtl " + (material != nullptr ? *material : std::string("default")) + "\n";
    material_ = material;
    const std::string* group = name(groups, f);
    if (mesh_.addresses.empty() && group == group_) return;
    group_ = group;
    text += 'g';
    if (group != nullptr) text += ' ' + *group;
    if (!mesh_.addresses.empty()) append_address(text += ' ', mesh_.addresses[f]);
    text.push_back('\n');
  }

 private:
  static const std::string* name(const FacetNames& names, std::size_t f) {
    if (names.empty() || names.of_facet[f] == kNothing) return nullptr;
    return &names.names[names.of_facet[f]];
  }
  static void append_address(std::string& text, const FacetAddress& address) {
    append_integer(text += 'f', address.level).push_back('_');
    if (address.parent) {
      append_integer(text, index(*address.parent));
    } else {
      text.push_back('-');
    }
  }

  const MeshView& mesh_;
  const std::string *material_ = nullptr, *group_ = nullptr;
};

void append_texture(std::string& text, const MeshAttributes<double>& attributes) {
  for (const auto& p : attributes.texture.values) {
    append_double(text += "vt ", p.x);
    if (attributes.texture_size > 1) append_double(text += ' ', p.y);
    if (attributes.texture_size > 2) append_double(text += ' ', p.z);
    text.push_back('\n');
  }
}

}  // namespace

std::string obj_text(const MeshView& mesh, const MeshWriteOptions& options) {
  std::string text = unit_comment(options);
  if (mesh.attributes != nullptr) {
    for (const std::string& library : mesh.attributes->material_libraries) text += "mtllib " + library + "\n";
  }
  for (const auto& p : mesh.points) append_point(text += "v ", p).push_back('\n');
  const bool textured = mesh.attributes != nullptr && !mesh.attributes->texture.empty();
  if (textured) append_texture(text, *mesh.attributes);
  ObjNames names(mesh);
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    if (mesh.facets[f].empty()) continue;
    names.append(text, f);
    text.push_back('f');
    std::size_t corner = mesh.facets.start(f);
    for (const VertexId v : mesh.facets[f]) {
      append_integer(text += ' ', index(v) + 1);
      const std::uint32_t value = textured ? mesh.attributes->texture.of_corner[corner++] : kNothing;
      if (value != kNothing) append_integer(text += '/', std::uint64_t{value} + 1);
    }
    text.push_back('\n');
  }
  return text;
}

std::string off_text(const MeshView& mesh, const MeshWriteOptions& options) {
  const std::vector<Colour> colours = facet_colours(mesh, options.color);
  std::string text = "OFF\n" + unit_comment(options);
  append_integer(text, mesh.points.size()).push_back(' ');
  append_integer(text, facet_count(mesh)) += " 0\n";
  for (const auto& p : mesh.points) append_point(text, p).push_back('\n');
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    if (mesh.facets[f].empty()) continue;
    append_integer(text, mesh.facets[f].size());
    for (const VertexId v : mesh.facets[f]) append_integer(text += ' ', index(v));
    if (!colours.empty()) {
      for (const std::uint8_t channel : colours[f]) append_integer(text += ' ', static_cast<int>(channel));
    }
    text.push_back('\n');
  }
  return text;
}

/// Faces are clockwise seen from outside, as OpenSCAD wants them.
std::string scad_text(const MeshView& mesh, const MeshWriteOptions& options) {
  std::string text = options.unit.empty() ? std::string() : "// unit " + options.unit + "\n";
  text += "polyhedron(\n  points = [\n";
  for (const auto& p : mesh.points) {
    append_17_digits(text += "    [", p.x);
    append_17_digits(text += ", ", p.y);
    append_17_digits(text += ", ", p.z);
    text += "],\n";
  }
  text += "  ],\n  faces = [\n";
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const auto loop = mesh.facets[f];
    if (loop.empty()) continue;
    text += "    [";
    for (std::size_t i = loop.size(); i-- > 0;) append_integer(text, index(loop[i])) += i == 0 ? "],\n" : ", ";
  }
  return text += "  ],\n  convexity = 10\n);\n";
}

float narrowed(double value, const char* element, std::size_t number) {
  const auto rounded = static_cast<float>(value);  // to nearest, ties to even
  if (!std::isfinite(rounded)) {
    throw InvalidInput("NotRepresentable", "a coordinate is beyond the range of a float",
                       element + (" " + std::to_string(number)));
  }
  return rounded;
}

namespace {

void check_texture(const std::vector<Point3<double>>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& p = values[i];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw InvalidInput("NotRepresentable", "a texture coordinate is beyond the range of a double", "texture coordinate " + std::to_string(i));
    }
  }
}

}  // namespace

std::string mesh_text(Format format, const MeshView& mesh, const MeshWriteOptions& options) {
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const auto& p = mesh.points[v];
    if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
      throw InvalidInput("NotRepresentable", "a coordinate is beyond the range of a double", "vertex " + std::to_string(v));
    }
  }
  if (mesh.attributes != nullptr) check_texture(mesh.attributes->texture.values);
  switch (format) {
    case Format::obj: return obj_text(mesh, options);
    case Format::off: return off_text(mesh, options);
    case Format::ply: return ply_text(mesh, options);
    case Format::ply_ascii: return ply_ascii_text(mesh, options);
    case Format::ply_float: return ply_float_text(mesh, options);
    case Format::stl: return stl_text(mesh);
    case Format::stl_ascii: return stl_ascii_text(mesh);
    case Format::scad: return scad_text(mesh, options);
    case Format::planes:
    case Format::certificate: break;
  }
  throw InvalidInput("NotRepresentable", "a mesh of rounded points has no exact planes to be written", "");
}

}  // namespace hexact::io
