// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/rational.hpp"
#include "hexact/kernel/polygon_soup.hpp"

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hexact::validation {

/// What OpenSCAD prints about a solid that it computed exactly.
struct OpenscadStatistics {
  bool simple = false;
  std::size_t vertices = 0, edges = 0, facets = 0;
};
/// Nullopt where a line is missing, as for objects that OpenSCAD did not compute by Boolean operations.
[[nodiscard]] std::optional<OpenscadStatistics> parse_statistics(std::string_view output);

/// The triangles that OpenSCAD exports, every coordinate exactly the decimal that it wrote.
struct OpenscadMesh {
  std::vector<Point3<Rational>> points;
  std::vector<std::array<std::size_t, 3>> triangles;  ///< polygons are fanned
};
/// Reads the OFF that OpenSCAD writes. Throws ParseError with the line on anything else.
[[nodiscard]] OpenscadMesh parse_openscad_off(std::string_view text);

}  // namespace hexact::validation
