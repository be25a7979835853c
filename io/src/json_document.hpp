// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/quadratic_field.hpp"
#include "hexact/kernel/errors.hpp"

#include <nlohmann/json.hpp>

#include <cstdint>
#include <initializer_list>
#include <string>
#include <string_view>

// What the JSON documents have in common: exact numbers, and errors that name the path to what is wrong.
namespace hexact::io {

using nlohmann::json;

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

/// Refuses what is no object, and keys beyond the known ones.
void require_keys(const Node& node, std::initializer_list<const char*> known);
/// Refuses documents of another kind or version.
void require_kind(const Node& document, const char* kind);
void require_array(const Node& node);
/// An exact number: a JSON number as the decimal it spells, or a string p, p/q or p/q+r/s*sqrt5.
[[nodiscard]] QuadraticField number(const Node& node);
/// An integer from 0 to 4294967294.
[[nodiscard]] std::uint32_t count(const Node& node);

/// Parses JSON, decimals kept as the text they were spelled in. Throws ParseError with the byte.
[[nodiscard]] json parse_document(std::string_view bytes, const std::string& name);
/// The bytes of a file of at most 256 MiB, "-" being standard input. Throws FileError, ResourceLimit.
[[nodiscard]] std::string read_document(const std::string& path, const char* kind);

}  // namespace hexact::io
