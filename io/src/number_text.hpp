// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <charconv>
#include <concepts>
#include <string>

namespace hexact::io {

/// Appends an integer in decimal.
template <std::integral T>
std::string& append_integer(std::string& text, T value) {
  char buffer[24];
  const auto result = std::to_chars(buffer, buffer + sizeof(buffer), value);
  return text.append(buffer, result.ptr);
}

/// Appends the shortest decimal that reads back as the same double. Precondition: finite.
inline std::string& append_double(std::string& text, double value) {
  char buffer[32];
  const auto result = std::to_chars(buffer, buffer + sizeof(buffer), value);
  return text.append(buffer, result.ptr);
}

}  // namespace hexact::io
