// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/kernel/polygon_soup.hpp"
#include "hexact/kernel/progress.hpp"

#include <cstddef>
#include <optional>
#include <variant>

namespace hexact {

/// What to make of a mesh; the steps are applied in the order of the fields.
struct PrepareOptions {
  bool fit_planes = false;             ///< exact planes for nearly planar facets: fit_planes.hpp
  bool hull = false;                   ///< convex hull of the vertices: convex_hull.hpp
  std::optional<Rational> truncate;    ///< θ in (0, 1/2): truncate.hpp
  bool dual = false;                   ///< dual.hpp
  std::optional<Rational> corner_cut;  ///< t in (0, 1/2): corner_cut.hpp
  bool triangulate = false;            ///< triangulate.hpp
  std::optional<unsigned> snap_bits;   ///< 2 … 4096: snap_planes.hpp

  /// Coplanar neighbours are merged first where facets count as such: with no step at all, and before fitting,
  /// truncating or snapping. Dual, corner cut and triangulation speak of the facets as they are, the hull of none.
  [[nodiscard]] bool merges_first() const noexcept {
    if (hull && !fit_planes) return false;
    const bool as_they_are = dual || corner_cut.has_value() || triangulate;
    return fit_planes || truncate.has_value() || !as_they_are;
  }
};

using ExactSoup = std::variant<PolygonSoup<Rational>, PolygonSoup<QuadraticField>>;

struct PreparedMesh {
  ExactSoup soup;
  std::optional<PlaneBody> body;       ///< set by snapping, whose planes are the result
  double max_displacement = 0;         ///< proven bound of how far fitting and snapping moved vertices, file units
  std::size_t merged_facets = 0;       ///< facets that disappeared by merging
  std::size_t dropped_vertices = 0;    ///< vertices that disappeared by merging
  std::size_t truncated_vertices = 0;
};

/// Carries out the steps; can be cancelled between them. Throws what the steps throw; each says what it requires.
[[nodiscard]] PreparedMesh prepare(const ExactSoup& soup, const PrepareOptions& options,
                                   const ProgressPart& progress = {});

}  // namespace hexact
