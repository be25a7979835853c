// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/io/masks_file.hpp"

#include "json_document.hpp"

#include <algorithm>

namespace hexact::io {
namespace {

constexpr std::uint32_t kLargestValence = 1000;

Rational rational(const Node& node) {
  const QuadraticField x = number(node);
  if (!x.is_rational()) node.refuse("must be rational");
  return x.rational_part();
}

Node required(const Node& node, const char* key) {
  if (!node.has(key)) node.refuse(std::string("has no \"") + key + "\"");
  return node.at(key);
}

std::string text(const Node& node) {
  if (!node.value.is_string()) node.refuse("must be a string");
  return node.value.get<std::string>();
}

SpectrumScheme scheme(const Node& node) {
  const std::string name = text(node);
  for (const SpectrumScheme s : {SpectrumScheme::loop, SpectrumScheme::catmull_clark, SpectrumScheme::doo_sabin}) {
    if (name == name_of(s)) return s;
  }
  node.refuse("must be loop, catmull-clark or doo-sabin");
}

std::vector<Rational> numbers(const Node& node) {
  require_array(node);
  std::vector<Rational> out;
  for (std::size_t i = 0; i < node.value.size(); ++i) out.push_back(rational(node.at(i)));
  return out;
}

/// A square matrix as an array of rows, all of the same length.
std::vector<Rational> block(const Node& node) {
  require_array(node);
  std::vector<Rational> out;
  for (std::size_t r = 0; r < node.value.size(); ++r) {
    const std::vector<Rational> row = numbers(node.at(r));
    if (row.size() != node.value.size()) node.at(r).refuse("must have as many numbers as the block has rows");
    out.insert(out.end(), row.begin(), row.end());
  }
  if (out.empty()) node.refuse("must have a row");
  return out;
}

ExtraordinaryMask mask(const Node& node, bool blocks) {
  require_keys(node, {"valence", blocks ? "blocks" : "weights"});
  ExtraordinaryMask out;
  const Node valence = required(node, "valence");
  const std::uint32_t k = count(valence);
  if (k < 3 || k > kLargestValence) valence.refuse("must be from 3 to 1000");
  out.valence = static_cast<int>(k);
  if (!blocks) {
    out.weights = numbers(required(node, "weights"));
    return out;
  }
  const Node list = required(node, "blocks");
  require_array(list);
  for (std::size_t d = 0; d < list.value.size(); ++d) out.blocks.push_back(block(list.at(d)));
  return out;
}

}  // namespace

MasksDocument parse_masks(std::string_view bytes, const std::string& name) {
  const json root = parse_document(bytes, name);
  const Node node{root, "", name};
  require_keys(node, {"hexact", "version", "name", "scheme", "masks"});
  require_kind(node, "masks");
  MasksDocument out;
  out.name = node.has("name") ? text(node.at("name")) : std::string("masks");
  if (node.has("scheme")) out.scheme = scheme(node.at("scheme"));
  const Node masks = required(node, "masks");
  require_array(masks);
  for (std::size_t i = 0; i < masks.value.size(); ++i) {
    out.masks.push_back(mask(masks.at(i), !out.scheme));
    const int k = out.masks.back().valence;
    const auto same = std::count_if(out.masks.begin(), out.masks.end(), [k](const auto& m) { return m.valence == k; });
    if (same > 1) masks.at(i).at("valence").refuse("is given twice");
  }
  if (out.masks.empty()) masks.refuse("must have a mask");
  return out;
}

MasksDocument read_masks(const std::string& path) { return parse_masks(read_document(path, "masks"), path); }

}  // namespace hexact::io
