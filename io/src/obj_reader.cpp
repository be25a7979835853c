// SPDX-License-Identifier: LGPL-3.0-or-later
#include "line_scanner.hpp"
#include "readers.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <optional>

namespace hexact::io {
namespace {

/// Statements that say nothing about points and facets.
constexpr std::array<std::string_view, 18> kIgnored = {"vt",   "vn",     "vp",       "o",   "s",         "mg",
                                                       "p",    "l",      "usemtl",   "mtllib", "usemap", "maplib",
                                                       "bevel", "lod",   "c_interp", "d_interp", "shadow_obj",
                                                       "trace_obj"};

/// A corner that names a vertex which had not been read by then.
struct ForwardReference {
  std::int64_t vertex;  ///< 1-based
  std::uint64_t line;
  std::size_t facet;
};

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& name)
      : scanner_(bytes, name, LineScanner::Comments::anywhere) {}

  PolygonSoup<Rational> read() {
    while (scanner_.next_line()) statement(scanner_.word());
    for (const ForwardReference& reference : forward_) {
      if (static_cast<std::size_t>(reference.vertex) > soup_.points.size()) {
        scanner_.fail_at(reference.line, no_vertex(reference.vertex), {"facet", reference.facet});
      }
    }
    if (soup_.points.empty()) scanner_.fail("the file has no vertices");
    if (!all_addressed_) soup_.addresses.clear();
    return std::move(soup_);
  }

 private:
  void statement(std::string_view keyword) {
    if (keyword == "v") return vertex();
    if (keyword == "f") return facet();
    if (keyword == "g") return group();
    if (std::find(kIgnored.begin(), kIgnored.end(), keyword) != kIgnored.end()) return;
    scanner_.fail("unknown statement " + quoted(keyword));
  }

  /// v x y z [w] or v x y z r g b.
  void vertex() {
    const Element element{"vertex", soup_.points.size()};
    Point3<Rational> point;
    point.x = scanner_.coordinate(element);
    point.y = scanner_.coordinate(element);
    point.z = scanner_.coordinate(element);
    const std::size_t extra = scanner_.words_left();
    if (extra == 1 && scanner_.coordinate(element) != Rational(1)) scanner_.fail("a weight other than 1", element);
    for (std::size_t i = 0; extra == 3 && i < 3; ++i) (void)scanner_.coordinate(element);
    scanner_.expect_end(element);
    soup_.points.push_back(std::move(point));
  }

  void facet() {
    const Element element{"facet", soup_.facets.size()};
    std::size_t corners = 0;
    for (std::string_view word = scanner_.word(); !word.empty(); word = scanner_.word()) {
      if (word == "\\" && scanner_.words_left() == 0) {  // the statement goes on in the next line
        scanner_.expect_line("the rest of the facet", element);
        continue;
      }
      soup_.facets.add_corner(corner(word, element));
      ++corners;
    }
    if (corners < 3) scanner_.fail("expected at least 3 corners, found " + std::to_string(corners), element);
    soup_.facets.close_loop();
    all_addressed_ = all_addressed_ && address_.has_value();
    if (address_) soup_.addresses.push_back(*address_);
  }

  /// i, i/t, i//n or i/t/n; negative numbers count back from the last vertex read.
  VertexId corner(std::string_view word, Element element) {
    std::int64_t vertex = part(word.substr(0, word.find('/')), word, element);
    std::size_t slashes = 0;
    for (std::size_t at = word.find('/'); at != std::string_view::npos; at = word.find('/', at + 1)) {
      const std::string_view rest = word.substr(at + 1, word.find('/', at + 1) - at - 1);
      ++slashes;
      const bool may_be_empty = slashes == 1 && at + 1 < word.size() && word[at + 1] == '/';
      if (slashes > 2) scanner_.fail("expected a corner v/vt/vn, found " + quoted(word), element);
      if (!may_be_empty) (void)part(rest, word, element);
    }
    const auto known = static_cast<std::int64_t>(soup_.points.size());
    const std::int64_t given = vertex;
    if (vertex < 0) vertex += known + 1;
    if (vertex < 1) scanner_.fail(no_vertex(given), element);
    if (vertex > known) forward_.push_back({vertex, scanner_.line(), element.number});
    return make_id<VertexId>(static_cast<std::size_t>(vertex - 1));
  }

  /// An index of a corner: not zero.
  std::int64_t part(std::string_view text, std::string_view word, Element element) const {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
      scanner_.fail("expected a corner v/vt/vn, found " + quoted(word), element);
    }
    if (value == 0 || value > 0xfffffffeLL || value < -0xfffffffeLL) scanner_.fail(no_vertex(value), element);
    return value;
  }

  std::string no_vertex(std::int64_t vertex) const {
    return "the index " + std::to_string(vertex) + " names nothing: there are " + std::to_string(soup_.points.size()) +
           " vertices, counted from 1";
  }

  /// g f<level>_<parent> is the address of the facets that follow.
  void group() {
    address_.reset();
    const std::string_view name = scanner_.word();
    const std::size_t bar = name.find('_');
    if (!name.starts_with('f') || bar == std::string_view::npos || scanner_.words_left() != 0) return;
    const auto level = number32(name.substr(1, bar - 1));
    const auto parent = number32(name.substr(bar + 1));
    if (!level || (!parent && name.substr(bar + 1) != "-")) return;
    address_ = FacetAddress{*level, std::nullopt};
    if (parent) address_->parent = make_id<VertexId>(*parent);
  }

  static std::optional<std::uint32_t> number32(std::string_view text) {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
  }

  LineScanner scanner_;
  PolygonSoup<Rational> soup_;
  std::optional<FacetAddress> address_;
  bool all_addressed_ = true;
  std::vector<ForwardReference> forward_;
};

}  // namespace

PolygonSoup<Rational> parse_obj(std::string_view bytes, const std::string& name) { return ObjReader(bytes, name).read(); }

}  // namespace hexact::io
