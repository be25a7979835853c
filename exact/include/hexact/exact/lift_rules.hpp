// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/chamfer.hpp"

#include <cstdint>

namespace hexact {

/// The fraction of every side that a chamfer step keeps at least; a pure function of the level whose edges are cut.
using KeptFraction = std::function<double(std::uint32_t level)>;

/// The same fraction at every level, 0 < keep < 1. Facets then shrink to points.
[[nodiscard]] KeptFraction constant_keep(double keep);
/// 1 − 2^-(k+2) for the k-th chamfer step, k = 0, 1, …: the lifts of step k take at most the fraction 2^-(k+2) of every
/// side. Whether lifts keep the budgets under which the limit is C¹ (docs/smooth-limit.md) is decided by `smooth_limit`;
/// those of this choice did wherever it was tried, constant_keep(0.5) often does not. The shortest edges then fall faster than
/// geometrically, and the planes widen by about k bits at step k.
[[nodiscard]] KeptFraction smooth_keep(std::uint32_t start_level);

/// The default rule. With β = (1 − keep)/2, a lift starts from β times the shortest edge beside it times the sine of its
/// angle, so that the side moves in by that share of the edge; then, until nothing changes,
///   τ ← 0.9·(sum of the other two) where it is above 0.95 of it,
///   the three lifts at a vertex are scaled down where a side would lose more than β of its length at that end.
/// All lifts are computed from those of the round before (Jacobi), so the order of elements does not matter. Both rules
/// only lower lifts; should they not come to an end in 200 rounds, lifts fall back to one constant small enough.
/// Floating point proposes, `chamfer_step` decides.
[[nodiscard]] LiftRule automatic_lifts(KeptFraction keep);

}  // namespace hexact
