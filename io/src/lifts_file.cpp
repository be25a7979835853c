// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/io/lifts_file.hpp"

#include "json_document.hpp"

namespace hexact::io {
namespace {

Rational rational(const Node& node) {
  const QuadraticField x = number(node);
  if (!x.is_rational()) node.refuse("must be rational");
  return x.rational_part();
}

std::vector<Rational> rationals(const Node& node) {
  require_array(node);
  std::vector<Rational> out;
  for (std::size_t i = 0; i < node.value.size(); ++i) out.push_back(rational(node.at(i)));
  return out;
}

LiftDocument::Edge lifted_edge(const Node& node) {
  if (!node.value.is_array() || node.value.size() != 3) node.refuse("must be [a, b, lift]");
  return {count(node.at(0)), count(node.at(1)), rational(node.at(2))};
}

LiftDocument::Level lifted_level(const Node& node) {
  require_keys(node, {"level", "edges", "lifts"});
  if (!node.has("level")) node.refuse("has no \"level\"");
  if (node.has("edges") == node.has("lifts")) node.refuse("must have either \"edges\" or \"lifts\"");
  LiftDocument::Level out;
  out.level = count(node.at("level"));
  if (node.has("lifts")) {
    out.lifts = rationals(node.at("lifts"));
    return out;
  }
  const Node edges = node.at("edges");
  require_array(edges);
  out.edges.emplace();
  for (std::size_t i = 0; i < edges.value.size(); ++i) out.edges->push_back(lifted_edge(edges.at(i)));
  return out;
}

}  // namespace

LiftDocument parse_lifts(std::string_view bytes, const std::string& name) {
  const json root = parse_document(bytes, name);
  const Node node{root, "", name};
  require_keys(node, {"hexact", "version", "default", "factors", "levels"});
  require_kind(node, "lifts");
  LiftDocument out;
  if (node.has("default")) {
    if (node.value["default"] != "auto") node.at("default").refuse("must be \"auto\"");
    out.automatic_otherwise = true;
  }
  if (node.has("factors")) out.factors = rationals(node.at("factors"));
  if (node.has("levels")) {
    const Node levels = node.at("levels");
    require_array(levels);
    for (std::size_t i = 0; i < levels.value.size(); ++i) out.levels.push_back(lifted_level(levels.at(i)));
  }
  return out;
}

LiftDocument read_lifts(const std::string& path) { return parse_lifts(read_document(path, "lifts"), path); }

}  // namespace hexact::io
