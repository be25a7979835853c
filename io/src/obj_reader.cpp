// SPDX-License-Identifier: LGPL-3.0-or-later
#include "line_scanner.hpp"
#include "readers.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <string>

namespace hexact::io {
namespace {

/// Statements that say nothing about points and facets.
constexpr std::array<std::string_view, 15> kIgnored = {"vn",     "vp",    "o",   "s",        "mg",       "p",          "l",
                                                       "usemap", "maplib", "bevel", "lod",    "c_interp", "d_interp",
                                                       "shadow_obj", "trace_obj"};

/// What a number in a corner counts.
struct Kind {
  const char* plural;
};
constexpr Kind kVertices{"vertices"}, kTexture{"texture coordinates"};

/// A corner that names something which had not been read by then.
struct ForwardReference {
  const Kind* kind;
  std::int64_t number;  ///< 1-based
  std::uint64_t line;
  std::size_t facet;
};

/// Something wrong with the texture coordinates of a facet.
struct Problem {
  std::string message;
  std::uint64_t line;
  std::size_t facet;
};

/// The numbers of one corner, 0-based.
struct Corner {
  std::size_t vertex = 0;
  std::optional<std::size_t> texture;
};

/// The name that a statement gives to all facets that follow.
class NamesInForce {
 public:
  explicit NamesInForce(FacetNames& out) : out_(out) {}
  /// An empty name stands for none.
  void set(const std::string& name) {
    current_ = kNothing;
    if (name.empty()) return;
    const auto [place, fresh] = number_.insert({name, static_cast<std::uint32_t>(out_.names.size())});
    if (fresh) out_.names.push_back(name);
    current_ = place->second;
  }
  void add_facet() {
    out_.of_facet.push_back(current_);
    any_ = any_ || current_ != kNothing;
  }
  /// No list where no facet has a name.
  void finish() {
    if (!any_) out_ = {};
  }

 private:
  FacetNames& out_;
  std::map<std::string, std::uint32_t> number_;
  std::uint32_t current_ = kNothing;
  bool any_ = false;
};

class ObjReader {
 public:
  ObjReader(std::string_view bytes, const std::string& name)
      : scanner_(bytes, name, LineScanner::Comments::anywhere) {}

  PolygonSoup<Rational> read() {
    while (scanner_.next_line()) statement(scanner_.word());
    for (const ForwardReference& reference : forward_) check(reference);
    if (soup_.points.empty()) scanner_.fail("the file has no vertices");
    if (!all_addressed_) soup_.addresses.clear();
    finish_texture();
    groups_.finish();
    materials_.finish();
    return std::move(soup_);
  }

 private:
  void statement(std::string_view keyword) {
    if (keyword == "v") return vertex();
    if (keyword == "f") return facet();
    if (keyword == "vt") return texture_coordinate();
    if (keyword == "g") return group();
    if (keyword == "usemtl") return materials_.set(rest_of_line());
    if (keyword == "mtllib") return soup_.attributes.material_libraries.push_back(rest_of_line());
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

  /// vt u [v [w]].
  void texture_coordinate() {
    const Element element{"texture coordinate", texture().values.size()};
    const std::size_t numbers = scanner_.words_left();
    if (numbers > 3) scanner_.fail("expected 1 to 3 numbers, found " + std::to_string(numbers), element);
    Point3<Rational> value;
    value.x = scanner_.coordinate(element);
    if (numbers > 1) value.y = scanner_.coordinate(element);
    if (numbers > 2) value.z = scanner_.coordinate(element);
    texture_size_ = std::max(texture_size_, static_cast<unsigned>(numbers));
    soup_.attributes.texture_size = texture_size_;
    texture().values.push_back(std::move(value));
  }

  void facet() {
    const Element element{"facet", soup_.facets.size()};
    std::size_t corners = 0, with_texture = 0;
    for (std::string_view word = scanner_.word(); !word.empty(); word = scanner_.word()) {
      if (word == "\\" && scanner_.words_left() == 0) {  // the statement goes on in the next line
        scanner_.expect_line("the rest of the facet", element);
        continue;
      }
      const Corner c = corner(word, element);
      soup_.facets.add_corner(make_id<VertexId>(c.vertex));
      texture().of_corner.push_back(c.texture ? static_cast<std::uint32_t>(*c.texture) : kNothing);
      with_texture += c.texture ? 1 : 0;
      ++corners;
    }
    if (corners < 3) scanner_.fail("expected at least 3 corners, found " + std::to_string(corners), element);
    if (with_texture != 0 && with_texture != corners) {
      note_problem(std::to_string(with_texture) + " of " + std::to_string(corners) + " corners have texture coordinates", element);
    }
    textured_ = textured_ || with_texture > 0;
    soup_.facets.close_loop();
    groups_.add_facet();
    materials_.add_facet();
    all_addressed_ = all_addressed_ && address_.has_value();
    if (address_) soup_.addresses.push_back(*address_);
  }

  /// i, i/t, i//n or i/t/n; negative numbers count back from the last one read.
  Corner corner(std::string_view word, Element element) {
    Corner result;
    result.vertex = resolved(kVertices, part(kVertices, word.substr(0, word.find('/')), word, element), element);
    std::size_t slashes = 0;
    for (std::size_t at = word.find('/'); at != std::string_view::npos; at = word.find('/', at + 1)) {
      const std::string_view rest = word.substr(at + 1, word.find('/', at + 1) - at - 1);
      ++slashes;
      const bool may_be_empty = slashes == 1 && at + 1 < word.size() && word[at + 1] == '/';
      if (slashes > 2) scanner_.fail("expected a corner v/vt/vn, found " + quoted(word), element);
      if (may_be_empty) continue;
      const std::int64_t number = part(kTexture, rest, word, element);
      if (slashes == 1) result.texture = resolved(kTexture, number, element);
    }
    return result;
  }

  void check(const ForwardReference& reference) {
    if (static_cast<std::size_t>(reference.number) <= known(*reference.kind)) return;
    const std::string message = no_such(*reference.kind, reference.number);
    if (reference.kind == &kVertices) scanner_.fail_at(reference.line, message, {"facet", reference.facet});
    if (!problem_) problem_ = Problem{message, reference.line, reference.facet};
  }
  /// Keeps the first thing that is wrong with texture coordinates: it counts only if the file has any.
  void note_problem(std::string message, Element element) {
    if (!problem_) problem_ = Problem{std::move(message), scanner_.line(), element.number};
  }
  void finish_texture() {
    if (texture().values.empty() || !textured_) {
      texture() = {};
      soup_.attributes.texture_size = 2;
    } else if (problem_) {
      scanner_.fail_at(problem_->line, problem_->message, {"facet", problem_->facet});
    }
  }

  /// The 0-based position that a number in a corner means.
  std::size_t resolved(const Kind& kind, std::int64_t given, Element element) {
    const auto count = static_cast<std::int64_t>(known(kind));
    const std::int64_t number = given < 0 ? given + count + 1 : given;
    if (number < 1) {
      if (&kind == &kVertices) scanner_.fail(no_such(kind, given), element);
      note_problem(no_such(kind, given), element);
      return 0;
    }
    if (number > count) forward_.push_back({&kind, number, scanner_.line(), element.number});
    return static_cast<std::size_t>(number - 1);
  }

  /// An index of a corner: not zero.
  std::int64_t part(const Kind& kind, std::string_view text, std::string_view word, Element element) const {
    std::int64_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size()) {
      scanner_.fail("expected a corner v/vt/vn, found " + quoted(word), element);
    }
    if (value == 0 || value > 0xfffffffeLL || value < -0xfffffffeLL) scanner_.fail(no_such(kind, value), element);
    return value;
  }

  std::size_t known(const Kind& kind) const {
    return &kind == &kVertices ? soup_.points.size() : soup_.attributes.texture.values.size();
  }
  std::string no_such(const Kind& kind, std::int64_t number) const {
    return "the index " + std::to_string(number) + " names nothing: there are " + std::to_string(known(kind)) + " " + kind.plural +
           ", counted from 1";
  }

  std::string rest_of_line() {
    std::string text;
    for (std::string_view word = scanner_.word(); !word.empty(); word = scanner_.word()) {
      if (!text.empty()) text += ' ';
      text += word;
    }
    return text;
  }

  /// g NAME… f<level>_<parent>: the group of the facets that follow, and their address; both may be missing.
  void group() {
    address_.reset();
    std::string name = rest_of_line();
    const std::size_t blank = name.rfind(' ');
    address_ = address_of(std::string_view(name).substr(blank == std::string::npos ? 0 : blank + 1));
    if (address_) name.resize(blank == std::string::npos ? 0 : blank);
    groups_.set(name);
  }

  static std::optional<FacetAddress> address_of(std::string_view name) {
    const std::size_t bar = name.find('_');
    if (!name.starts_with('f') || bar == std::string_view::npos) return std::nullopt;
    const auto level = number32(name.substr(1, bar - 1));
    const auto parent = number32(name.substr(bar + 1));
    if (!level || (!parent && name.substr(bar + 1) != "-")) return std::nullopt;
    FacetAddress address{*level, std::nullopt};
    if (parent) address.parent = make_id<VertexId>(*parent);
    return address;
  }

  static std::optional<std::uint32_t> number32(std::string_view text) {
    std::uint32_t value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (text.empty() || error != std::errc() || end != text.data() + text.size()) return std::nullopt;
    return value;
  }

  CornerValues<Rational>& texture() { return soup_.attributes.texture; }

  LineScanner scanner_;
  PolygonSoup<Rational> soup_;
  NamesInForce groups_{soup_.attributes.groups}, materials_{soup_.attributes.materials};
  unsigned texture_size_ = 1;
  bool textured_ = false;
  std::optional<Problem> problem_;
  std::optional<FacetAddress> address_;
  bool all_addressed_ = true;
  std::vector<ForwardReference> forward_;
};

}  // namespace

PolygonSoup<Rational> parse_obj(std::string_view bytes, const std::string& name) { return ObjReader(bytes, name).read(); }

}  // namespace hexact::io
