// SPDX-License-Identifier: LGPL-3.0-or-later
#include "line_scanner.hpp"
#include "ply_header.hpp"
#include "readers.hpp"

#include "hexact/kernel/errors.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <vector>

namespace hexact::io {
namespace {

/// Where values come from when the file is text.
class AsciiSource {
 public:
  AsciiSource(std::string_view bytes, const std::string& name, const PlyHeader& header)
      : scanner_(bytes, name, LineScanner::Comments::whole_lines) {
    while (scanner_.line() < header.body_line) {
      if (!scanner_.next_line()) break;
    }
  }
  void begin(Element element) {
    element_ = element;
    scanner_.expect_line("an element", element);
  }
  void end() { scanner_.expect_end(element_); }
  Rational number(PlyType type) {
    if (is_float(type)) return scanner_.coordinate(element_);
    return Rational(static_cast<long long>(integer(type)));
  }
  std::int64_t integer(PlyType) { return scanner_.integer("an integer", -0x80000000LL, 0xffffffffLL, element_); }
  void need(std::size_t, PlyType) {}  // a line that is too short ends by itself
  void finish() {
    if (scanner_.next_line()) scanner_.fail("expected the end of the file, found " + quoted(scanner_.word()));
  }
  [[noreturn]] void fail(const std::string& message) const { scanner_.fail(message, element_); }

 private:
  LineScanner scanner_;
  Element element_;
};

/// Where values come from when the file is binary. There are no lines; errors name the element.
class BinarySource {
 public:
  BinarySource(std::string_view bytes, const std::string& name, const PlyHeader& header)
      : rest_(bytes.substr(header.body)), name_(name),
        swap_((header.encoding == PlyEncoding::big_endian) == (std::endian::native == std::endian::little)) {}
  void begin(Element element) { element_ = element; }
  void end() {}
  Rational number(PlyType type) {
    if (!is_float(type)) return Rational(static_cast<long long>(integer(type)));
    const double value = type == PlyType::float32 ? static_cast<double>(take<float>()) : take<double>();
    if (!std::isfinite(value)) fail("a coordinate is not finite");
    return Rational::from_double(value);
  }
  std::int64_t integer(PlyType type) {
    switch (type) {
      case PlyType::int8: return take<std::int8_t>();
      case PlyType::uint8: return take<std::uint8_t>();
      case PlyType::int16: return take<std::int16_t>();
      case PlyType::uint16: return take<std::uint16_t>();
      case PlyType::int32: return take<std::int32_t>();
      case PlyType::uint32: return take<std::uint32_t>();
      case PlyType::float32: (void)take<float>(); return 0;
      case PlyType::float64: (void)take<double>(); return 0;
    }
    return 0;
  }
  /// Throws unless that many values can follow.
  void need(std::size_t values, PlyType type) {
    if (values > rest_.size() / size_of(type)) {
      fail("a list of " + std::to_string(values) + " entries, but only " + std::to_string(rest_.size()) + " bytes follow");
    }
  }
  void finish() {
    if (!rest_.empty()) {
      throw ParseError(std::to_string(rest_.size()) + " bytes follow the last element", name_, std::nullopt);
    }
  }
  [[noreturn]] void fail(const std::string& message) const {
    throw ParseError(element_.str() + ": " + message, name_, std::nullopt, element_.str());
  }

 private:
  template <class T>
  T take() {
    if (rest_.size() < sizeof(T)) fail("the file ends within this element");
    char buffer[sizeof(T)];
    std::memcpy(buffer, rest_.data(), sizeof(T));
    rest_.remove_prefix(sizeof(T));
    if (swap_) std::reverse(buffer, buffer + sizeof(T));
    T value;
    std::memcpy(&value, buffer, sizeof(T));
    return value;
  }

  std::string_view rest_;
  std::string name_;
  bool swap_;
  Element element_;
};

template <class Source>
std::size_t list_length(Source& source, const PlyProperty& property) {
  const std::int64_t length = source.integer(*property.list_count);
  if (length < 0) source.fail("a list of " + std::to_string(length) + " entries");
  source.need(static_cast<std::size_t>(length), property.type);
  return static_cast<std::size_t>(length);
}

template <class Source>
void skip(Source& source, const PlyProperty& property) {
  const std::size_t values = property.list_count ? list_length(source, property) : 1;
  for (std::size_t i = 0; i < values; ++i) {
    if (is_float(property.type)) {
      (void)source.number(property.type);
    } else {
      (void)source.integer(property.type);
    }
  }
}

/// The names under which programs store texture coordinates of vertices.
bool is_u(const PlyProperty& p) { return !p.list_count && (p.name == "s" || p.name == "u" || p.name == "texture_u"); }
bool is_v(const PlyProperty& p) { return !p.list_count && (p.name == "t" || p.name == "v" || p.name == "texture_v"); }
bool is_texture_list(const PlyProperty& p) { return p.list_count && p.name == "texcoord" && is_float(p.type); }

template <class Source>
Point3<Rational> read_vertex(Source& source, const PlyElement& element, Point3<Rational>& texture) {
  Point3<Rational> point;
  for (const PlyProperty& property : element.properties) {
    if (property.name == "x") {
      point.x = source.number(property.type);
    } else if (property.name == "y") {
      point.y = source.number(property.type);
    } else if (property.name == "z") {
      point.z = source.number(property.type);
    } else if (is_u(property)) {
      texture.x = source.number(property.type);
    } else if (is_v(property)) {
      texture.y = source.number(property.type);
    } else {
      skip(source, property);
    }
  }
  return point;
}

bool is_corner_list(const PlyProperty& property) {
  return property.name == "vertex_indices" || property.name == "vertex_index";
}

template <class Source>
void read_corners(Source& source, const PlyProperty& property, std::size_t vertices, FacetLoops& loops) {
  const std::size_t corners = list_length(source, property);
  if (corners < 3) source.fail("expected at least 3 corners, found " + std::to_string(corners));
  for (std::size_t i = 0; i < corners; ++i) {
    const std::int64_t corner = source.integer(property.type);
    if (corner < 0 || static_cast<std::size_t>(corner) >= vertices) {
      source.fail("the corner " + std::to_string(corner) + " is no vertex: there are " + std::to_string(vertices) +
                  ", counted from 0");
    }
    loops.add_corner(make_id<VertexId>(static_cast<std::size_t>(corner)));
  }
  loops.close_loop();
}

/// A list of u and v for each corner, or an empty one.
template <class Source>
std::vector<Point3<Rational>> read_texture_list(Source& source, const PlyProperty& property) {
  const std::size_t numbers = list_length(source, property);
  if (numbers % 2 != 0) source.fail("a list texcoord of " + std::to_string(numbers) + " numbers, expected pairs");
  std::vector<Point3<Rational>> values;  // grows as they are read: nothing promises that they are all there
  for (std::size_t i = 0; i < numbers / 2; ++i) {
    Point3<Rational> value;
    value.x = source.number(property.type);
    value.y = source.number(property.type);
    values.push_back(std::move(value));
  }
  return values;
}

/// Gives the last facet of the soup the values; it may have none.
template <class Source>
void add_texture(Source& source, PolygonSoup<Rational>& soup, std::vector<Point3<Rational>> values) {
  CornerValues<Rational>& texture = soup.attributes.texture;
  const std::size_t corners = soup.facets[soup.facets.size() - 1].size();
  if (!values.empty() && values.size() != corners) {
    source.fail("texture coordinates for " + std::to_string(values.size()) + " corners, but there are " + std::to_string(corners));
  }
  for (std::size_t i = 0; i < corners; ++i) {
    texture.of_corner.push_back(values.empty() ? kNothing : static_cast<std::uint32_t>(texture.values.size()));
    if (!values.empty()) texture.values.push_back(std::move(values[i]));
  }
}

template <class Source>
FacetAddress read_facet(Source& source, const PlyElement& element, std::size_t vertices, PolygonSoup<Rational>& soup) {
  FacetLoops& loops = soup.facets;
  std::vector<Point3<Rational>> texture;
  FacetAddress address;
  for (const PlyProperty& property : element.properties) {
    const bool integer = !property.list_count && !is_float(property.type);
    if (is_corner_list(property)) {
      read_corners(source, property, vertices, loops);
    } else if (is_texture_list(property)) {
      texture = read_texture_list(source, property);
    } else if (integer && property.name == "level") {
      const std::int64_t level = source.integer(property.type);
      if (level < 0) source.fail("the level " + std::to_string(level) + " is negative");
      address.level = static_cast<std::uint32_t>(level);
    } else if (integer && property.name == "parent") {
      const std::int64_t parent = source.integer(property.type);
      if (parent < -1) source.fail("the parent " + std::to_string(parent) + " is negative");
      if (parent >= 0) address.parent = make_id<VertexId>(static_cast<std::size_t>(parent));
    } else {
      skip(source, property);
    }
  }
  if (std::any_of(element.properties.begin(), element.properties.end(), is_texture_list)) add_texture(source, soup, std::move(texture));
  return address;
}

bool has_scalar(const PlyElement& element, std::string_view name) {
  return std::any_of(element.properties.begin(), element.properties.end(), [&](const PlyProperty& property) {
    return property.name == name && !property.list_count;
  });
}

const PlyElement* find_element(const PlyHeader& header, std::string_view name) {
  for (const PlyElement& element : header.elements) {
    if (element.name == name) return &element;
  }
  return nullptr;
}

/// The properties that a mesh needs.
void check_elements(const PlyHeader& header, const std::string& name) {
  const PlyElement* vertex = find_element(header, "vertex");
  if (vertex == nullptr) throw ParseError("the header declares no element vertex", name, header.body_line);
  for (const char* axis : {"x", "y", "z"}) {
    if (!has_scalar(*vertex, axis)) {
      throw ParseError(std::string("the element vertex has no property ") + axis, name, vertex->line);
    }
  }
  const PlyElement* face = find_element(header, "face");
  if (face == nullptr) return;
  const auto lists = std::count_if(face->properties.begin(), face->properties.end(), [](const PlyProperty& property) {
    return is_corner_list(property) && property.list_count && !is_float(property.type);
  });
  const auto named = std::count_if(face->properties.begin(), face->properties.end(), is_corner_list);
  if (lists != 1 || named != 1) {
    throw ParseError("the element face needs one list of integers vertex_indices", name, face->line);
  }
}

/// binary32 where every coordinate is a float.
FloatFormat coordinate_format(const PlyElement& vertex) {
  const auto wider = [](const PlyProperty& p) {
    return (p.name == "x" || p.name == "y" || p.name == "z") && p.type != PlyType::float32;
  };
  return std::any_of(vertex.properties.begin(), vertex.properties.end(), wider) ? FloatFormat::binary64 : FloatFormat::binary32;
}

/// Coordinates of corners win over those of vertices; a mesh without any has no lists.
void finish_texture(PolygonSoup<Rational>& soup, std::vector<Point3<Rational>> vertex_texture) {
  CornerValues<Rational>& texture = soup.attributes.texture;
  if (texture.values.empty()) texture.of_corner.clear();
  if (!texture.empty() || vertex_texture.empty()) return;
  texture.values = std::move(vertex_texture);
  for (const VertexId v : soup.facets.corners()) texture.of_corner.push_back(static_cast<std::uint32_t>(v));
}

template <class Source>
PolygonSoup<Rational> read_elements(Source source, const PlyHeader& header) {
  PolygonSoup<Rational> soup;
  const PlyElement& vertex = *find_element(header, "vertex");
  soup.storage.coordinates = coordinate_format(vertex);
  const std::size_t vertices = vertex.count;
  const bool textured_vertices = std::any_of(vertex.properties.begin(), vertex.properties.end(), is_u) &&
                                 std::any_of(vertex.properties.begin(), vertex.properties.end(), is_v);
  std::vector<Point3<Rational>> vertex_texture;
  for (const PlyElement& element : header.elements) {
    const bool addressed = has_scalar(element, "level") && has_scalar(element, "parent");
    if (element.properties.empty()) continue;
    for (std::size_t i = 0; i < element.count; ++i) {
      if (element.name == "vertex") {
        source.begin({"vertex", i});
        Point3<Rational> texture;
        soup.points.push_back(read_vertex(source, element, texture));
        if (textured_vertices) vertex_texture.push_back(std::move(texture));
      } else if (element.name == "face") {
        source.begin({"facet", i});
        const FacetAddress address = read_facet(source, element, vertices, soup);
        if (addressed) soup.addresses.push_back(address);
      } else {
        source.begin({element.name.c_str(), i});
        for (const PlyProperty& property : element.properties) skip(source, property);
      }
      source.end();
    }
  }
  source.finish();
  finish_texture(soup, std::move(vertex_texture));
  return soup;
}

}  // namespace

PolygonSoup<Rational> parse_ply(std::string_view bytes, const std::string& name) {
  const PlyHeader header = parse_ply_header(bytes, name);
  check_elements(header, name);
  if (header.encoding == PlyEncoding::ascii) return read_elements(AsciiSource(bytes, name, header), header);
  return read_elements(BinarySource(bytes, name, header), header);
}

}  // namespace hexact::io
