// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/validation/openscad_output.hpp"

#include "hexact/kernel/errors.hpp"

#include <charconv>

namespace hexact::validation {
namespace {

std::string_view trimmed(std::string_view s) {
  const auto first = s.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return s.substr(first, s.find_last_not_of(" \t\r\n") - first + 1);
}

std::optional<std::size_t> whole_number(std::string_view text) {
  std::size_t value = 0;
  const auto end = text.data() + text.size();
  const auto parsed = std::from_chars(text.data(), end, value);
  if (parsed.ec != std::errc() || parsed.ptr != end) return std::nullopt;
  return value;
}

/// The text behind `name:` on its own line.
std::optional<std::string_view> value_of(std::string_view output, std::string_view name) {
  while (!output.empty()) {
    const auto end = output.find('\n');
    const std::string_view line = trimmed(output.substr(0, end));
    output = end == std::string_view::npos ? std::string_view() : output.substr(end + 1);
    if (line.size() > name.size() && line.substr(0, name.size()) == name && line[name.size()] == ':') {
      return trimmed(line.substr(name.size() + 1));
    }
  }
  return std::nullopt;
}

/// Words one after another, with the line they stand on.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}

  std::string_view next() {
    while (!rest_.empty() && std::string_view(" \t\r\n").find(rest_.front()) != std::string_view::npos) {
      if (rest_.front() == '\n') ++line_;
      rest_.remove_prefix(1);
    }
    const std::string_view word = rest_.substr(0, rest_.find_first_of(" \t\r\n"));
    rest_.remove_prefix(word.size());
    return word;
  }
  std::size_t count(std::size_t bound) {
    const auto value = whole_number(next());
    if (!value || *value > bound) fail("a count or an index was expected");
    return *value;
  }
  Rational number() {
    Rational value;
    if (Rational::parse(next(), value) != Rational::ParseResult::ok) fail("a coordinate was expected");
    return value;
  }
  [[noreturn]] void fail(const std::string& message) const { throw ParseError(message, "OpenSCAD's OFF", line_); }

 private:
  std::string_view rest_;
  std::uint64_t line_ = 1;
};

}  // namespace

std::optional<OpenscadStatistics> parse_statistics(std::string_view output) {
  const auto simple = value_of(output, "Simple");
  const auto number = [&](std::string_view name) {
    const auto text = value_of(output, name);
    return text ? whole_number(*text) : std::nullopt;
  };
  const auto vertices = number("Vertices"), edges = number("Edges"), facets = number("Facets");
  if (!simple || !vertices || !edges || !facets) return std::nullopt;
  return OpenscadStatistics{*simple == "yes", *vertices, *edges, *facets};
}

OpenscadMesh parse_openscad_off(std::string_view text) {
  Words words(text);
  if (words.next() != "OFF") words.fail("the file does not begin with OFF");
  const std::size_t bound = text.size();  // every element takes more than a byte
  const std::size_t points = words.count(bound), facets = words.count(bound);
  (void)words.count(bound);
  OpenscadMesh mesh;
  mesh.points.reserve(points);
  for (std::size_t i = 0; i < points; ++i) {
    Rational x = words.number(), y = words.number(), z = words.number();
    mesh.points.push_back({std::move(x), std::move(y), std::move(z)});
  }
  for (std::size_t f = 0; f < facets; ++f) {
    const std::size_t size = words.count(bound);
    if (size < 3 || points == 0) words.fail("a facet has fewer than 3 corners");
    const std::size_t first = words.count(points - 1);
    std::size_t previous = words.count(points - 1);
    for (std::size_t i = 2; i < size; ++i) {
      const std::size_t corner = words.count(points - 1);
      mesh.triangles.push_back({first, previous, corner});
      previous = corner;
    }
  }
  return mesh;
}

}  // namespace hexact::validation
