// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hexact::io {

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

[[nodiscard]] std::size_t size_of(PlyType type) noexcept;
[[nodiscard]] bool is_float(PlyType type) noexcept;

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::int32;      ///< of the value, or of the entries of a list
  std::optional<PlyType> list_count;  ///< type of a list's length; none for a scalar
};

struct PlyElement {
  std::string name;
  std::size_t count = 0;
  std::uint64_t line = 0;
  std::vector<PlyProperty> properties;
};

enum class PlyEncoding { ascii, little_endian, big_endian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<PlyElement> elements;
  std::size_t body = 0;         ///< position of the first byte behind the header
  std::uint64_t body_line = 0;  ///< number of lines of the header
};

/// Reads the header and holds every count against the size of the file before anything is allocated.
[[nodiscard]] PlyHeader parse_ply_header(std::string_view bytes, const std::string& name);

}  // namespace hexact::io
