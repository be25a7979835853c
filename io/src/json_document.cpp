// SPDX-License-Identifier: LGPL-3.0-or-later
#include "json_document.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <iostream>
#include <limits>

namespace hexact::io {
namespace {

constexpr std::size_t kLargestFile = std::size_t{256} << 20;

/// Builds the document with decimals as the text they were spelled in, where the library would round them.
class ExactReader : public nlohmann::detail::json_sax_dom_parser<json> {
 public:
  using Base = nlohmann::detail::json_sax_dom_parser<json>;
  ExactReader(json& document, const std::string& file) : Base(document, true), file_(file) {}
  bool number_float(double, const std::string& text) {
    std::string copy = text;
    return Base::string(copy);
  }
  bool parse_error(std::size_t position, const std::string&, const nlohmann::detail::exception& e) {
    throw ParseError("byte " + std::to_string(position) + ": " + e.what(), file_, std::nullopt);
  }

 private:
  const std::string& file_;
};

}  // namespace

void require_keys(const Node& node, std::initializer_list<const char*> known) {
  if (!node.value.is_object()) node.refuse("must be an object");
  for (const auto& [key, unused] : node.value.items()) {
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      throw ParseError(node.path + "/" + key + ": unknown key", node.file, std::nullopt, node.path + "/" + key);
    }
  }
}

/// Decimals were kept as their text by the reader below, so that they are exact.
QuadraticField number(const Node& node) {
  if (node.value.is_number_integer()) {
    Integer n;
    if (Integer::parse(node.value.dump(), n)) return Rational(n);
  }
  if (!node.value.is_string()) node.refuse("must be a number or a string p, p/q");
  const auto text = node.value.get<std::string>();
  Rational r;
  QuadraticField x;
  if (Rational::parse(text, r) == Rational::ParseResult::ok) return r;
  if (!QuadraticField::parse(text, x)) node.refuse("is no finite number");
  return x;
}

std::uint32_t count(const Node& node) {
  if (!node.value.is_number_unsigned() || node.value.get<std::uint64_t>() >= std::numeric_limits<std::uint32_t>::max()) {
    node.refuse("must be an integer from 0 to 4294967294");
  }
  return static_cast<std::uint32_t>(node.value.get<std::uint64_t>());
}

void require_kind(const Node& document, const char* kind) {
  if (!document.has("hexact") || document.value["hexact"] != kind) {
    document.refuse(std::string("must say \"hexact\": \"") + kind + "\"");
  }
  if (!document.has("version") || document.value["version"] != 1) document.refuse("must say \"version\": 1");
}

void require_array(const Node& node) {
  if (!node.value.is_array()) node.refuse("must be an array");
}

json parse_document(std::string_view bytes, const std::string& name) {
  json root;
  ExactReader reader(root, name);
  json::sax_parse(bytes.begin(), bytes.end(), &reader);
  return root;
}

std::string read_document(const std::string& path, const char* kind) {
  std::ifstream file;
  if (path != "-") {
    file.open(path, std::ios::binary);
    if (!file || file.peek() == std::ifstream::traits_type::eof()) throw FileError("cannot be read, or is empty", path);
  }
  std::istream& in = path == "-" ? std::cin : file;
  std::string bytes;
  std::array<char, 1 << 16> block;
  while (in.read(block.data(), block.size()), in.gcount() > 0) {
    bytes.append(block.data(), static_cast<std::size_t>(in.gcount()));
    if (bytes.size() > kLargestFile) throw ResourceLimit(path + ": a document of " + kind + " has at most 256 MiB");
  }
  return bytes;
}

}  // namespace hexact::io
