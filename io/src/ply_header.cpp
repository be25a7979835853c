// SPDX-License-Identifier: LGPL-3.0-or-later
#include "ply_header.hpp"

#include "line_scanner.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace hexact::io {
namespace {

PlyType read_type(LineScanner& scanner) {
  static constexpr std::array<std::pair<std::string_view, PlyType>, 16> kNames = {{
      {"char", PlyType::int8},     {"uchar", PlyType::uint8},     {"short", PlyType::int16},
      {"ushort", PlyType::uint16}, {"int", PlyType::int32},       {"uint", PlyType::uint32},
      {"float", PlyType::float32}, {"double", PlyType::float64},  {"int8", PlyType::int8},
      {"uint8", PlyType::uint8},   {"int16", PlyType::int16},     {"uint16", PlyType::uint16},
      {"int32", PlyType::int32},   {"uint32", PlyType::uint32},   {"float32", PlyType::float32},
      {"float64", PlyType::float64},
  }};
  const std::string_view word = scanner.expect_word("a type");
  for (const auto& [name, type] : kNames) {
    if (word == name) return type;
  }
  scanner.fail("expected a type such as float or uchar, found " + quoted(word));
}

void read_format(LineScanner& scanner, PlyHeader& header) {
  scanner.expect_line("the line format");
  if (scanner.word() != "format") scanner.fail("expected the line format");
  const std::string_view encoding = scanner.expect_word("an encoding");
  if (encoding == "ascii") {
    header.encoding = PlyEncoding::ascii;
  } else if (encoding == "binary_little_endian") {
    header.encoding = PlyEncoding::little_endian;
  } else if (encoding == "binary_big_endian") {
    header.encoding = PlyEncoding::big_endian;
  } else {
    scanner.fail("expected ascii, binary_little_endian or binary_big_endian, found " + quoted(encoding));
  }
  if (scanner.word() != "1.0") scanner.fail("expected version 1.0");
  scanner.expect_end();
}

void read_element(LineScanner& scanner, PlyHeader& header) {
  PlyElement element;
  element.name = scanner.expect_word("the name of an element");
  element.line = scanner.line();
  element.count = scanner.count(element.name.c_str(), 1);
  scanner.expect_end();
  for (const PlyElement& other : header.elements) {
    if (other.name == element.name) scanner.fail("the element " + quoted(element.name) + " is declared twice");
  }
  header.elements.push_back(std::move(element));
}

void read_property(LineScanner& scanner, PlyHeader& header) {
  if (header.elements.empty()) scanner.fail("a property before the first element");
  PlyProperty property;
  const LineScanner::Mark before = scanner.mark();
  if (scanner.word() == "list") {
    property.list_count = read_type(scanner);
    if (is_float(*property.list_count)) scanner.fail("the length of a list must be an integer");
  } else {
    scanner.reset(before);
  }
  property.type = read_type(scanner);
  property.name = scanner.expect_word("the name of a property");
  scanner.expect_end();
  auto& properties = header.elements.back().properties;
  for (const PlyProperty& other : properties) {
    if (other.name == property.name) scanner.fail("the property " + quoted(property.name) + " is declared twice");
  }
  properties.push_back(std::move(property));
}

/// Fewest bytes that one item of the element takes.
std::size_t fewest_bytes(const PlyElement& element, PlyEncoding encoding) {
  if (encoding == PlyEncoding::ascii) return std::max<std::size_t>(1, 2 * element.properties.size());
  std::size_t bytes = 0;
  for (const PlyProperty& property : element.properties) bytes += size_of(property.list_count.value_or(property.type));
  return bytes;
}

void check_counts(const LineScanner& scanner, const PlyHeader& header) {
  const std::size_t left = scanner.bytes_left() + (header.encoding == PlyEncoding::ascii ? 1 : 0);
  for (const PlyElement& element : header.elements) {
    const std::size_t each = fewest_bytes(element, header.encoding);
    if (each != 0 && element.count > left / each) {
      scanner.fail_at(element.line, std::to_string(element.count) + " of " + quoted(element.name) +
                                        " are announced, but only " + std::to_string(scanner.bytes_left()) +
                                        " bytes follow");
    }
  }
}

}  // namespace

std::size_t size_of(PlyType type) noexcept {
  constexpr std::array<std::size_t, 8> kSizes = {1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

bool is_float(PlyType type) noexcept { return type == PlyType::float32 || type == PlyType::float64; }

PlyHeader parse_ply_header(std::string_view bytes, const std::string& name) {
  LineScanner scanner(bytes, name, LineScanner::Comments::anywhere);
  PlyHeader header;
  if (!scanner.next_line() || scanner.word() != "ply") scanner.fail("expected the first line ply");
  read_format(scanner, header);
  while (true) {
    scanner.expect_line("end_header");
    const std::string_view keyword = scanner.word();
    if (keyword == "end_header") break;
    if (keyword == "comment" || keyword == "obj_info") continue;
    if (keyword == "element") {
      read_element(scanner, header);
    } else if (keyword == "property") {
      read_property(scanner, header);
    } else {
      scanner.fail("expected element, property, comment or end_header, found " + quoted(keyword));
    }
  }
  scanner.expect_end();
  header.body = scanner.next_start();
  header.body_line = scanner.line();
  check_counts(scanner, header);
  return header;
}

}  // namespace hexact::io
