// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/io/parameters_file.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <iostream>
#include <iterator>
#include <limits>

namespace hexact::io {
namespace {

using nlohmann::json;

constexpr std::size_t kLargestFile = std::size_t{256} << 20;

/// A JSON value with the path that led to it.
struct Node {
  const json& value;
  std::string path;
  const std::string& file;

  [[noreturn]] void refuse(const std::string& message) const {
    throw ParseError((path.empty() ? std::string("document") : path) + ": " + message, file, std::nullopt, path);
  }
  [[nodiscard]] Node at(const std::string& key) const { return {value.at(key), path + "/" + key, file}; }
  [[nodiscard]] Node at(std::size_t i) const { return {value.at(i), path + "/" + std::to_string(i), file}; }
  [[nodiscard]] bool has(const std::string& key) const { return value.contains(key); }
};

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

ParameterDocument::Edge edge(const Node& node) {
  if (!node.value.is_array() || node.value.size() != 4) node.refuse("must be [a, b, λab, λba]");
  return {count(node.at(0)), count(node.at(1)), number(node.at(2)), number(node.at(3))};
}

ParameterDocument::Level level(const Node& node) {
  require_keys(node, {"level", "sizes", "edges"});
  if (!node.has("level")) node.refuse("has no \"level\"");
  ParameterDocument::Level out;
  out.level = count(node.at("level"));
  if (node.has("sizes")) {
    const Node sizes = node.at("sizes");
    if (!sizes.value.is_object()) sizes.refuse("must be an object");
    for (const auto& [key, unused] : sizes.value.items()) {
      std::uint32_t n = 0;
      const auto [end, error] = std::from_chars(key.data(), key.data() + key.size(), n);
      if (error != std::errc() || end != key.data() + key.size() || n < 3) sizes.at(key).refuse("is no facet size");
      if (!out.sizes.emplace(n, number(sizes.at(key))).second) sizes.at(key).refuse("is given twice");
    }
  }
  if (node.has("edges")) {
    const Node edges = node.at("edges");
    if (!edges.value.is_array()) edges.refuse("must be an array");
    for (std::size_t i = 0; i < edges.value.size(); ++i) out.edges.push_back(edge(edges.at(i)));
  }
  return out;
}

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

ParameterDocument parse_parameters(std::string_view bytes, const std::string& name) {
  json root;
  ExactReader reader(root, name);
  json::sax_parse(bytes.begin(), bytes.end(), &reader);
  const Node node{root, "", name};
  require_keys(node, {"hexact", "version", "default", "levels"});
  if (!node.has("hexact") || node.value["hexact"] != "parameters") node.refuse("must say \"hexact\": \"parameters\"");
  if (!node.has("version") || node.value["version"] != 1) node.refuse("must say \"version\": 1");
  ParameterDocument out;
  if (node.has("default")) {
    if (!node.value["default"].is_string()) node.at("default").refuse("must be the text of a policy");
    out.default_policy = node.value["default"].get<std::string>();
  }
  if (node.has("levels")) {
    const Node levels = node.at("levels");
    if (!levels.value.is_array()) levels.refuse("must be an array");
    for (std::size_t i = 0; i < levels.value.size(); ++i) out.levels.push_back(level(levels.at(i)));
  }
  return out;
}

ParameterDocument read_parameters(const std::string& path) {
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
    if (bytes.size() > kLargestFile) throw ResourceLimit(path + ": a document of parameters has at most 256 MiB");
  }
  return parse_parameters(bytes, path);
}

}  // namespace hexact::io
