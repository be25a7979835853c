// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/io/parameters_file.hpp"

#include "json_document.hpp"

#include <charconv>

namespace hexact::io {
namespace {

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

}  // namespace

ParameterDocument parse_parameters(std::string_view bytes, const std::string& name) {
  const json root = parse_document(bytes, name);
  const Node node{root, "", name};
  require_keys(node, {"hexact", "version", "default", "levels"});
  require_kind(node, "parameters");
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

ParameterDocument read_parameters(const std::string& path) { return parse_parameters(read_document(path, "parameters"), path); }

}  // namespace hexact::io
