// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mesh_writers.hpp"
#include "number_text.hpp"

#include <algorithm>
#include <bit>
#include <vector>

namespace hexact::io {
namespace {

/// The unsigned bits of `value`, lowest byte first.
template <class T>
void append_bytes(std::string& text, T value) {
  for (std::size_t i = 0; i < sizeof(T); ++i) text.push_back(static_cast<char>(value >> (8 * i) & 0xff));
}

std::size_t largest_facet(const MeshView& mesh) {
  std::size_t largest = 0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) largest = std::max(largest, mesh.facets[f].size());
  return largest;
}

bool is_textured(const MeshView& mesh) { return mesh.attributes != nullptr && !mesh.attributes->texture.empty(); }

/// u and v in the corners of facet f, one pair after another; none where the facet has no texture coordinates.
std::vector<double> texture_of(const MeshView& mesh, std::size_t f) {
  std::vector<double> pairs;
  const CornerValues<double>& texture = mesh.attributes->texture;
  for (std::size_t c = mesh.facets.start(f); c < mesh.facets.start(f) + mesh.facets[f].size(); ++c) {
    if (texture.of_corner[c] == kNothing) return {};
    const auto& value = texture.values[texture.of_corner[c]];
    pairs.insert(pairs.end(), {value.x, value.y});
  }
  return pairs;
}

std::string header(const MeshView& mesh, const MeshWriteOptions& options, const char* encoding, const std::string& number) {
  std::size_t facets = 0;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) facets += mesh.facets[f].empty() ? 0 : 1;
  std::string text = std::string("ply\nformat ") + encoding + " 1.0\n";
  if (!options.unit.empty()) text += "comment unit " + options.unit + "\n";
  text += "element vertex " + std::to_string(mesh.points.size()) +
          "\nproperty " + number + " x\nproperty " + number + " y\nproperty " + number + " z\nelement face " +
          std::to_string(facets) +
          "\nproperty list " + (largest_facet(mesh) < 256 ? "uchar" : "uint") + " int vertex_indices\n";
  if (is_textured(mesh)) text += "property list uint double texcoord\n";
  if (!mesh.addresses.empty()) text += "property int level\nproperty int parent\n";
  if (!options.color.empty()) text += "property uchar red\nproperty uchar green\nproperty uchar blue\n";
  return text += "end_header\n";
}

std::int32_t parent_number(const FacetAddress& address) {
  return address.parent ? static_cast<std::int32_t>(*address.parent) : -1;
}

void append_binary_facets(std::string& text, const MeshView& mesh, const std::vector<Colour>& colours) {
  const bool small = largest_facet(mesh) < 256;
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const auto loop = mesh.facets[f];
    if (loop.empty()) continue;
    if (small) {
      append_bytes(text, static_cast<std::uint8_t>(loop.size()));
    } else {
      append_bytes(text, static_cast<std::uint32_t>(loop.size()));
    }
    for (const VertexId v : loop) append_bytes(text, static_cast<std::uint32_t>(v));
    if (is_textured(mesh)) {
      const std::vector<double> pairs = texture_of(mesh, f);
      append_bytes(text, static_cast<std::uint32_t>(pairs.size()));
      for (const double x : pairs) append_bytes(text, std::bit_cast<std::uint64_t>(x));
    }
    if (!mesh.addresses.empty()) {
      append_bytes(text, mesh.addresses[f].level);
      append_bytes(text, static_cast<std::uint32_t>(parent_number(mesh.addresses[f])));
    }
    if (!colours.empty()) {
      for (const std::uint8_t channel : colours[f]) append_bytes(text, channel);
    }
  }
}

}  // namespace

std::string ply_text(const MeshView& mesh, const MeshWriteOptions& options) {
  std::string text = header(mesh, options, "binary_little_endian", "double");
  for (const auto& p : mesh.points) {
    for (const double value : {p.x, p.y, p.z}) append_bytes(text, std::bit_cast<std::uint64_t>(value));
  }
  append_binary_facets(text, mesh, facet_colours(mesh, options.color));
  return text;
}

std::string ply_float_text(const MeshView& mesh, const MeshWriteOptions& options) {
  std::string text = header(mesh, options, "binary_little_endian", "float");
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const auto& p = mesh.points[v];
    for (const double value : {p.x, p.y, p.z}) append_bytes(text, std::bit_cast<std::uint32_t>(narrowed(value, "vertex", v)));
  }
  append_binary_facets(text, mesh, facet_colours(mesh, options.color));
  return text;
}

std::string ply_ascii_text(const MeshView& mesh, const MeshWriteOptions& options) {
  const std::vector<Colour> colours = facet_colours(mesh, options.color);
  std::string text = header(mesh, options, "ascii", "double");
  for (const auto& p : mesh.points) {
    append_double(text, p.x).push_back(' ');
    append_double(text, p.y).push_back(' ');
    append_double(text, p.z).push_back('\n');
  }
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const auto loop = mesh.facets[f];
    if (loop.empty()) continue;
    append_integer(text, loop.size());
    for (const VertexId v : loop) append_integer(text += ' ', index(v));
    if (is_textured(mesh)) {
      const std::vector<double> pairs = texture_of(mesh, f);
      append_integer(text += ' ', pairs.size());
      for (const double x : pairs) append_double(text += ' ', x);
    }
    if (!mesh.addresses.empty()) {
      append_integer(text += ' ', mesh.addresses[f].level);
      append_integer(text += ' ', parent_number(mesh.addresses[f]));
    }
    if (!colours.empty()) {
      for (const std::uint8_t channel : colours[f]) append_integer(text += ' ', static_cast<int>(channel));
    }
    text.push_back('\n');
  }
  return text;
}

}  // namespace hexact::io
