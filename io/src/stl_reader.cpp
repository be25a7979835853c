// SPDX-License-Identifier: LGPL-3.0-or-later
#include "line_scanner.hpp"
#include "readers.hpp"

#include "hexact/kernel/errors.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <unordered_map>

namespace hexact::io {
namespace {

constexpr std::size_t kHeaderBytes = 84;
constexpr std::size_t kTriangleBytes = 50;

std::uint32_t little_endian32(const char* bytes) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

struct PointHash {
  static std::size_t hash(const Rational& value) {
    const std::size_t low = mpz_get_ui(mpq_numref(value.raw()));
    const std::size_t denominator = mpz_size(mpq_denref(value.raw())) * 64 + mpz_scan1(mpq_denref(value.raw()), 0);
    return (low + denominator * 0x9e3779b97f4a7c15u + (value.sign() < 0 ? 1 : 0)) * 0xbf58476d1ce4e5b9u;
  }
  std::size_t operator()(const Point3<Rational>& p) const {
    std::size_t h = hash(p.x);
    h = (h ^ (h >> 29)) * 0x94d049bb133111ebu + hash(p.y);
    h = (h ^ (h >> 29)) * 0x94d049bb133111ebu + hash(p.z);
    return h ^ (h >> 32);
  }
};

struct BitsHash {
  std::size_t operator()(const std::array<std::uint32_t, 3>& p) const {
    std::size_t h = p[0];
    for (int i = 1; i < 3; ++i) h = (h ^ (h >> 29)) * 0x94d049bb133111ebu + p[static_cast<std::size_t>(i)];
    h *= 0xbf58476d1ce4e5b9u;
    return h ^ (h >> 32);
  }
};

bool same_word(std::string_view word, std::string_view keyword) {
  if (word.size() != keyword.size()) return false;
  for (std::size_t i = 0; i < word.size(); ++i) {
    const char lower = word[i] >= 'A' && word[i] <= 'Z' ? static_cast<char>(word[i] - 'A' + 'a') : word[i];
    if (lower != keyword[i]) return false;
  }
  return true;
}

/// Corners with equal coordinates are one vertex: the format has no other way to say so.
class AsciiStl {
 public:
  AsciiStl(std::string_view bytes, const std::string& name)
      : scanner_(bytes, name, LineScanner::Comments::whole_lines) {}

  PolygonSoup<Rational> read() {
    soup_.storage.triangles_only = true;
    scanner_.expect_line("solid");
    while (true) {
      keyword("solid", {});  // the rest of the line is a name
      while (true) {
        scanner_.expect_line("facet or endsolid", next());
        const std::string_view word = scanner_.word();
        if (same_word(word, "endsolid")) break;
        if (!same_word(word, "facet")) scanner_.fail("expected facet or endsolid, found " + quoted(word), next());
        triangle(next());
      }
      if (!scanner_.next_line()) break;
    }
    return std::move(soup_);
  }

 private:
  Element next() const { return {"facet", soup_.facets.size()}; }

  void keyword(std::string_view expected, Element element) {
    const std::string_view word = scanner_.word();
    if (!same_word(word, expected)) {
      scanner_.fail("expected " + std::string(expected) + ", found " + quoted(word), element);
    }
  }

  /// The normal is redundant and not looked at.
  void triangle(Element element) {
    scanner_.expect_line("outer loop", element);
    keyword("outer", element);
    keyword("loop", element);
    for (int i = 0; i < 3; ++i) {
      scanner_.expect_line("a vertex", element);
      keyword("vertex", element);
      Point3<Rational> point;
      point.x = scanner_.coordinate(element);
      point.y = scanner_.coordinate(element);
      point.z = scanner_.coordinate(element);
      scanner_.expect_end(element);
      const auto [at, is_new] = numbers_.try_emplace(point, soup_.points.size());
      if (is_new) soup_.points.push_back(std::move(point));
      soup_.facets.add_corner(make_id<VertexId>(at->second));
    }
    for (const char* end : {"endloop", "endfacet"}) {
      scanner_.expect_line(end, element);
      keyword(end, element);
      scanner_.expect_end(element);
    }
    soup_.facets.close_loop();
  }

  LineScanner scanner_;
  PolygonSoup<Rational> soup_;
  std::unordered_map<Point3<Rational>, std::size_t, PointHash> numbers_;
};

class BinaryStl {
 public:
  BinaryStl(std::string_view bytes, const std::string& name) : bytes_(bytes), name_(name) {}

  PolygonSoup<Rational> read() {
    soup_.storage = {FloatFormat::binary32, true};
    const std::uint64_t triangles = little_endian32(bytes_.data() + kHeaderBytes - 4);
    soup_.facets.reserve(triangles, 3 * triangles);
    for (std::size_t t = 0; t < triangles; ++t) {
      for (std::size_t corner = 1; corner < 4; ++corner) {  // 0 is the normal
        soup_.facets.add_corner(vertex(bytes_.data() + kHeaderBytes + t * kTriangleBytes + 12 * corner, t));
      }
      soup_.facets.close_loop();
    }
    return std::move(soup_);
  }

 private:
  VertexId vertex(const char* bytes, std::size_t triangle) {
    std::array<std::uint32_t, 3> key{};
    for (std::size_t i = 0; i < 3; ++i) {
      key[i] = little_endian32(bytes + 4 * i);
      if (!std::isfinite(std::bit_cast<float>(key[i]))) {
        const Element element{"facet", triangle};
        throw ParseError(element.str() + ": a coordinate is not finite", name_, std::nullopt, element.str());
      }
      if (key[i] == 0x80000000u) key[i] = 0;  // −0 is 0
    }
    const auto [at, is_new] = numbers_.try_emplace(key, soup_.points.size());
    if (is_new) {
      const auto exact = [&](std::size_t i) { return Rational::from_double(static_cast<double>(std::bit_cast<float>(key[i]))); };
      soup_.points.push_back({exact(0), exact(1), exact(2)});
    }
    return make_id<VertexId>(at->second);
  }

  std::string_view bytes_;
  std::string name_;
  PolygonSoup<Rational> soup_;
  std::unordered_map<std::array<std::uint32_t, 3>, std::size_t, BitsHash> numbers_;
};

}  // namespace

bool is_binary_stl(std::string_view bytes) {
  return bytes.size() >= kHeaderBytes &&
         bytes.size() == kHeaderBytes + kTriangleBytes * std::uint64_t{little_endian32(bytes.data() + kHeaderBytes - 4)};
}

PolygonSoup<Rational> parse_stl(std::string_view bytes, const std::string& name) {
  if (is_binary_stl(bytes)) return BinaryStl(bytes, name).read();
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first != std::string_view::npos && same_word(bytes.substr(first, 5), "solid")) return AsciiStl(bytes, name).read();
  if (bytes.size() < kHeaderBytes) {
    throw ParseError("neither a text that starts with solid nor a binary file: " + std::to_string(bytes.size()) +
                         " bytes, fewer than the 84 of a header", name, 1);
  }
  const std::uint64_t triangles = little_endian32(bytes.data() + kHeaderBytes - 4);
  throw ParseError("a binary file that announces " + std::to_string(triangles) + " triangles has " +
                       std::to_string(kHeaderBytes + kTriangleBytes * triangles) + " bytes, found " +
                       std::to_string(bytes.size()), name, 1);
}

}  // namespace hexact::io
