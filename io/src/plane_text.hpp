// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "line_scanner.hpp"

#include "hexact/exact/plane_body.hpp"

#include <string>
#include <vector>

namespace hexact::io {

/// Reads field, scale, shift, planes, loops and vertices. The scanner stands on the line `field`, and afterwards on
/// the line behind the body. Returns whether there is such a line.
struct BodyText {
  PlaneBody body;
  bool more = false;
};
[[nodiscard]] BodyText read_body(LineScanner& scanner);

/// Appends the same lines.
void append_body(std::string& text, const PlaneBody& body);

/// For every vertex its facets counter-clockwise from the one with the smallest number, when every vertex lies on
/// exactly three; otherwise `offending` is the first that does not and `facets` how many it lies on.
struct DerivedTriples {
  std::vector<std::array<FacetId, 3>> triples;
  std::optional<std::size_t> offending;
  std::size_t facets = 0;
};
/// Precondition: every corner is below `vertex_count`. Cost: linear.
[[nodiscard]] DerivedTriples derive_triples(const FacetLoops& loops, std::size_t vertex_count);

}  // namespace hexact::io
