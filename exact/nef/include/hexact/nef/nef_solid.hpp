// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/exact/verdict.hpp"

#include <cstddef>
#include <functional>
#include <string>

// The witness: claims about solids decided by exact Boolean operations on Nef polyhedra, with no code in common
// with the sign tests of the certificates. Bodies are taken in file coordinates, so two bodies may have different
// scales and shifts. Over Q(√5) every claim is undecided. Nothing of CGAL leaves these functions: its assertions
// and exceptions become the verdict `undecided` with their message.
namespace hexact {

struct NefOptions {
  /// Bodies with more planes are refused before any work. Cost grows like planes^2.2, see `nef_cost_estimate`.
  std::size_t max_facets = 400;
  /// Called with the finished fraction, 0 … 1, never falling; returning false ends the work as undecided. May be empty.
  std::function<bool(double)> progress;
};

/// Seconds that cutting a body with this many planes one by one is expected to take: 3.3 s for 326 planes growing
/// with the power 2.2, measured with CGAL 5.5.1 on honeycomb levels 0 to 5 of the cube (2-core Xeon, 2 GHz class).
/// Planes with long coefficients take up to 4 times as long.
[[nodiscard]] double nef_cost_seconds(std::size_t facets);
/// The same for people, e.g. "about 38 s cut by cut".
[[nodiscard]] std::string nef_cost_estimate(std::size_t facets);

/// Is the solid, built once from its facets and exact vertices, equal to the intersection of its facet half-spaces?
/// Refuted with a vertex and the exact excess over a half-space, or with an exact point that only one of both has.
/// Throws ResourceLimit, saying what it would cost, when the body has more planes than options.max_facets.
[[nodiscard]] ClaimVerdict nef_convex(const PlaneBody& body, const NefOptions& options = {});

/// Is `cut` equal to `base` intersected with all half-spaces of `cut`, cut by cut? Errors as for nef_convex.
[[nodiscard]] ClaimVerdict nef_corner_cut(const PlaneBody& base, const PlaneBody& cut, const NefOptions& options = {});

/// Is the difference inner − outer empty? Errors as for nef_convex; the bound holds for each body.
/// Cost: one Boolean operation, about planes^1.25.
[[nodiscard]] ClaimVerdict nef_inside(const PlaneBody& inner, const PlaneBody& outer, const NefOptions& options = {});

}  // namespace hexact
