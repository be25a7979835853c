// SPDX-License-Identifier: LGPL-3.0-or-later
#include "line_scanner.hpp"
#include "readers.hpp"

namespace hexact::io {
namespace {

/// Numbers that follow the coordinates of a vertex, as the prefixes of the keyword announce them.
struct VertexColumns {
  std::size_t fewest = 0, most = 0;
};

/// [ST][C][N]OFF; the keyword itself may be missing.
VertexColumns read_keyword(LineScanner& scanner, std::string_view keyword) {
  VertexColumns columns;
  const auto take = [&](std::string_view prefix, std::size_t fewest, std::size_t most) {
    if (!keyword.starts_with(prefix)) return;
    keyword.remove_prefix(prefix.size());
    columns.fewest += fewest;
    columns.most += most;
  };
  const std::string_view whole = keyword;
  take("ST", 2, 2);
  take("C", 3, 4);
  take("N", 3, 3);
  if (keyword != "OFF") scanner.fail("expected the keyword OFF, COFF or NOFF, found " + quoted(whole));
  return columns;
}

bool starts_with_digit(std::string_view word) { return !word.empty() && word[0] >= '0' && word[0] <= '9'; }

Point3<Rational> read_vertex(LineScanner& scanner, VertexColumns columns, Element element) {
  scanner.expect_line("a vertex", element);
  Point3<Rational> point;
  point.x = scanner.coordinate(element);
  point.y = scanner.coordinate(element);
  point.z = scanner.coordinate(element);
  std::size_t extra = scanner.words_left();
  if (extra < columns.fewest || extra > columns.most) {
    scanner.fail("expected 3 coordinates and " + std::to_string(columns.fewest) + " to " +
                     std::to_string(columns.most) + " further numbers, found " + std::to_string(3 + extra) + " numbers",
                 element);
  }
  for (; extra > 0; --extra) (void)scanner.coordinate(element);
  return point;
}

/// n, n corners, and a colour of 0, 1, 3 or 4 numbers.
void read_facet(LineScanner& scanner, std::size_t vertices, FacetLoops& loops, Element element) {
  scanner.expect_line("a facet", element);
  const auto corners = scanner.integer("a number of corners", 0, 0xfffffffe, element);
  if (corners < 3) scanner.fail("expected at least 3 corners, found " + std::to_string(corners), element);
  for (std::int64_t i = 0; i < corners; ++i) {
    const auto corner = scanner.integer("a vertex", 0, static_cast<std::int64_t>(vertices) - 1, element);
    loops.add_corner(make_id<VertexId>(static_cast<std::size_t>(corner)));
  }
  loops.close_loop();
  std::size_t colour = scanner.words_left();
  if (colour == 2 || colour > 4) {
    scanner.fail("expected a colour of 0, 1, 3 or 4 numbers after the corners, found " + std::to_string(colour), element);
  }
  for (; colour > 0; --colour) (void)scanner.coordinate(element);
}

}  // namespace

PolygonSoup<Rational> parse_off(std::string_view bytes, const std::string& name) {
  LineScanner scanner(bytes, name, LineScanner::Comments::anywhere);
  scanner.expect_line("the keyword OFF");
  const LineScanner::Mark at_counts = scanner.mark();  // where the keyword is missing
  VertexColumns columns;
  if (const std::string_view first = scanner.word(); starts_with_digit(first)) {
    scanner.reset(at_counts);
  } else {
    columns = read_keyword(scanner, first);
    if (scanner.words_left() == 0) scanner.expect_line("the numbers of vertices, facets and edges");
  }
  constexpr std::size_t kVertexBytes = 6, kFacetBytes = 8;
  const std::size_t vertices = scanner.count("vertices", kVertexBytes);
  const std::size_t facets = scanner.count("facets", kFacetBytes);
  if (scanner.words_left() != 0) (void)scanner.integer("the number of edges", 0, 0xffffffffffffffLL);
  scanner.expect_end();
  PolygonSoup<Rational> soup;
  soup.points.reserve(vertices);
  for (std::size_t v = 0; v < vertices; ++v) soup.points.push_back(read_vertex(scanner, columns, {"vertex", v}));
  soup.facets.reserve(facets, 4 * facets);
  for (std::size_t f = 0; f < facets; ++f) read_facet(scanner, vertices, soup.facets, {"facet", f});
  if (scanner.next_line()) scanner.fail("expected the end of the file, found " + quoted(scanner.word()));
  return soup;
}

}  // namespace hexact::io
