// SPDX-License-Identifier: LGPL-3.0-or-later
#include "plane_text.hpp"
#include "readers.hpp"

#include "hexact/exact/integer.hpp"

#include <algorithm>

namespace hexact::io {
namespace {

/// As for decimal exponents: beyond this a number would need absurd memory.
constexpr std::int64_t kLargestScale = 100000;
constexpr std::int64_t kLargestIndex = 0xfffffffe;

class BodyReader {
 public:
  explicit BodyReader(LineScanner& scanner) : scanner_(scanner) {}

  BodyText read() {
    read_field();
    read_scale();
    read_planes();
    read_loops();
    const bool more = scanner_.next_line();
    const LineScanner::Mark before = scanner_.mark();
    if (more && scanner_.word() == "vertices") {
      read_vertices();
      return {std::move(body_), scanner_.next_line()};
    }
    scanner_.reset(before);
    derive_vertices();
    return {std::move(body_), more};
  }

 private:
  void keyword(const char* expected) {
    const std::string_view word = scanner_.word();
    if (word != expected) scanner_.fail(std::string("expected ") + expected + ", found " + quoted(word));
  }

  void read_field() {
    keyword("field");
    const std::string_view field = scanner_.expect_word("Q or Q(sqrt5)");
    if (field == "Q(sqrt5)") {
      body_.field = Field::sqrt5;
    } else if (field != "Q") {
      scanner_.fail("expected Q or Q(sqrt5), found " + quoted(field));
    }
    scanner_.expect_end();
  }

  void read_scale() {
    scanner_.expect_line("scale");
    keyword("scale");
    body_.scale = static_cast<long>(scanner_.integer("a binary exponent", -kLargestScale, kLargestScale));
    scanner_.expect_end();
    scanner_.expect_line("planes");
    const LineScanner::Mark before = scanner_.mark();
    if (scanner_.word() != "shift") {
      scanner_.reset(before);
      return;
    }
    for (Rational& s : body_.shift) {
      s = scanner_.rational({});
      const Integer q = s.denominator();
      if (mpz_scan1(q.raw(), 0) + 1 != q.bit_length()) {
        scanner_.fail("a shift must be dyadic: its denominator a power of two");
      }
    }
    scanner_.expect_end();
    scanner_.expect_line("planes");
  }

  void read_planes() {
    keyword("planes");
    constexpr std::size_t kBytes = 12;  // "0 0 1 0 0 -\n"
    const std::size_t planes = scanner_.count("planes", kBytes);
    scanner_.expect_end();
    if (body_.field == Field::rational) body_.planes.reserve(planes);
    body_.addresses.reserve(planes);
    for (std::size_t i = 0; i < planes; ++i) {
      const Element element{"plane", i};
      scanner_.expect_line("a plane", element);
      if (body_.field == Field::rational) {
        read_rational_plane(element);
      } else {
        read_sqrt5_plane(element);
      }
      body_.addresses.push_back(read_address(element));
      scanner_.expect_end(element);
    }
  }

  void read_rational_plane(Element element) {
    IntegerPlanes::Narrow narrow{};
    const LineScanner::Mark line = scanner_.mark();
    for (std::int64_t& coefficient : narrow) {
      const auto value = scanner_.small_integer();
      if (!value) {
        scanner_.reset(line);
        return read_wide_plane(element);
      }
      coefficient = *value;
    }
    if (narrow[0] == 0 && narrow[1] == 0 && narrow[2] == 0) fail_zero_normal(element);
    body_.planes.push_back(narrow);
  }

  /// Fractions are cleared by the least common denominator, which is positive: the same half-space.
  void read_wide_plane(Element element) {
    std::array<Rational, 4> values;
    Integer denominator(1);
    for (Rational& value : values) {
      value = scanner_.rational(element);
      denominator = lcm(denominator, value.denominator());
    }
    if (values[0].is_zero() && values[1].is_zero() && values[2].is_zero()) fail_zero_normal(element);
    const auto cleared = [&](const Rational& value) {
      return value.numerator() * exact_quotient(denominator, value.denominator());
    };
    body_.planes.push_back(
        Plane<Integer>{cleared(values[0]), cleared(values[1]), cleared(values[2]), cleared(values[3])});
  }

  void read_sqrt5_plane(Element element) {
    Plane<QuadraticField> plane;
    plane.a = scanner_.quadratic(element);
    plane.b = scanner_.quadratic(element);
    plane.c = scanner_.quadratic(element);
    plane.d = scanner_.quadratic(element);
    if (plane.a.is_zero() && plane.b.is_zero() && plane.c.is_zero()) fail_zero_normal(element);
    body_.planes_sqrt5.push_back(std::move(plane));
  }

  [[noreturn]] void fail_zero_normal(Element element) const { scanner_.fail("the normal is zero", element); }

  FacetAddress read_address(Element element) {
    FacetAddress address;
    address.level = static_cast<std::uint32_t>(scanner_.integer("a level", 0, kLargestIndex, element));
    const LineScanner::Mark before = scanner_.mark();
    if (scanner_.word() == "-") return address;
    scanner_.reset(before);
    const auto parent = scanner_.integer("a parent or -:", 0, kLargestIndex, element);
    address.parent = make_id<VertexId>(static_cast<std::size_t>(parent));
    return address;
  }

  void read_loops() {
    scanner_.expect_line("loops");
    keyword("loops");
    const std::size_t loops = scanner_.count("loops", 2);
    scanner_.expect_end();
    if (loops != body_.plane_count()) {
      scanner_.fail("expected one loop for each of the " + std::to_string(body_.plane_count()) + " planes, found " +
                    std::to_string(loops));
    }
    loop_lines_.reserve(loops);
    body_.loops.reserve(loops, std::min(6 * loops, scanner_.bytes_left() / 2));
    for (std::size_t f = 0; f < loops; ++f) read_loop({"facet", f});
  }

  void read_loop(Element element) {
    scanner_.expect_line("a loop", element);
    loop_lines_.push_back(scanner_.line());
    const std::int64_t corners = scanner_.integer("a number of corners", 0, kLargestIndex, element);
    if (corners == 1 || corners == 2) {
      scanner_.fail("expected no corner or at least 3, found " + std::to_string(corners), element);
    }
    for (std::int64_t i = 0; i < corners; ++i) {
      const auto corner = static_cast<std::size_t>(scanner_.integer("a vertex", 0, kLargestIndex, element));
      vertex_bound_ = std::max(vertex_bound_, corner + 1);
      body_.loops.add_corner(make_id<VertexId>(corner));
    }
    scanner_.expect_end(element);
    body_.loops.close_loop();
  }

  void read_vertices() {
    const std::size_t vertices = scanner_.count("vertices", 6);
    scanner_.expect_end();
    if (vertex_bound_ > vertices) fail_corner(vertices);
    const auto last = static_cast<std::int64_t>(body_.plane_count()) - 1;
    body_.triples.reserve(vertices);
    for (std::size_t v = 0; v < vertices; ++v) {
      const Element element{"vertex", v};
      scanner_.expect_line("a vertex", element);
      std::array<FacetId, 3> triple{};
      for (FacetId& plane : triple) {
        plane = make_id<FacetId>(static_cast<std::size_t>(scanner_.integer("a plane", 0, last, element)));
      }
      scanner_.expect_end(element);
      if (triple[0] == triple[1] || triple[1] == triple[2] || triple[0] == triple[2]) {
        scanner_.fail("the three defining planes must differ", element);
      }
      body_.triples.push_back(triple);
    }
  }

  void derive_vertices() {
    // Each vertex has three corners, so a larger bound cannot be met and must not be allocated.
    if (vertex_bound_ > body_.loops.corner_count()) fail_corner(body_.loops.corner_count());
    DerivedTriples derived = derive_triples(body_.loops, vertex_bound_);
    if (derived.offending) {
      scanner_.fail("without a section vertices every vertex lies on exactly three facets; this one lies on " +
                        std::to_string(derived.facets), {"vertex", *derived.offending});
    }
    body_.triples = std::move(derived.triples);
  }

  /// Names the first corner that is no vertex.
  [[noreturn]] void fail_corner(std::size_t vertices) const {
    std::size_t f = 0;
    const auto is_wrong = [&](VertexId v) { return index(v) >= vertices; };
    while (std::none_of(body_.loops[f].begin(), body_.loops[f].end(), is_wrong)) ++f;
    const auto corner = *std::find_if(body_.loops[f].begin(), body_.loops[f].end(), is_wrong);
    scanner_.fail_at(loop_lines_[f],
                     "the corner " + std::to_string(index(corner)) + " is no vertex: there are at most " +
                         std::to_string(vertices) + ", counted from 0", {"facet", f});
  }

  LineScanner& scanner_;
  PlaneBody body_;
  std::vector<std::uint64_t> loop_lines_;
  std::size_t vertex_bound_ = 0;  ///< largest corner + 1
};

}  // namespace

BodyText read_body(LineScanner& scanner) { return BodyReader(scanner).read(); }

PlaneBody parse_planes(std::string_view bytes, const std::string& name) {
  LineScanner scanner(bytes, name, LineScanner::Comments::whole_lines);
  if (!scanner.next_line() || scanner.word() != "hexact-planes" || scanner.word() != "1") {
    scanner.fail("expected the first line hexact-planes 1");
  }
  scanner.expect_end();
  scanner.expect_line("field");
  BodyText text = read_body(scanner);
  if (text.more) scanner.fail("expected the end of the file, found " + quoted(scanner.word()));
  return std::move(text.body);
}

}  // namespace hexact::io
