// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/eigenvalues.hpp"
#include "hexact/exact/verdict.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace hexact {

/// What was proved of the ring of the characteristic map, sector 0 turned so that its middle is the positive x-axis.
struct RingProof {
  Verdict verdict = Verdict::undecided;
  int level = 0;         ///< double steps until the control points decide (midedge schemes); 0 for B-splines
  Rational jacobian;     ///< proven lower bound, see `prove_ring`; positive when proved
  Rational half_plane;   ///< proven lower bound of cos of the angle between a control point and the x-axis
  std::string reason;    ///< when it is not proved
};

/// Whether the limit surface is made of B-spline pieces: doo-sabin, catmull-clark, loop.
[[nodiscard]] bool is_bspline_scheme(SpectrumScheme scheme) noexcept;

/// Proves that the characteristic map of mode 1 is regular and injective on its ring, hence everywhere but at 0.
///
/// midedge, midedge6: after `level` double steps (none given: the first of a few that succeeds) both derivatives in a
/// cell are convex combinations of first differences of nearby control points; `jacobian` bounds the sine of the angle
/// from any difference in x to any in y of a cell from below. doo-sabin, catmull-clark, loop: Bernstein coefficients of
/// the Jacobian of each piece; `jacobian` bounds the least of them from below, relative to the greatest.
/// Injective: all control points (Bernstein coefficients) of sector 0 have `half_plane` > 0, so the ring winds once.
/// Bounds are multiples of 10^-6. Cost: milliseconds, times 4 for each level.
[[nodiscard]] RingProof prove_ring(SpectrumScheme scheme, const SubdivisionMatrix& matrix, const RationalInterval& eigenvalue,
                                   std::optional<int> level = std::nullopt);

/// Lines of the ring's sector 0 for pictures: images of a grid, in doubles, turned as above. Empty when the eigenvector
/// could not be enclosed.
using RingLines = std::vector<std::vector<std::array<double, 2>>>;
[[nodiscard]] RingLines ring_lines(SpectrumScheme scheme, const SubdivisionMatrix& matrix, const RationalInterval& eigenvalue);

}  // namespace hexact
