// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/exact/verdict.hpp"
#include "hexact/kernel/progress.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace hexact {

// Why chamfers become smooth, and what of it is decided on the levels that were made. docs/smooth-limit.md has the
// theorem and its proof; in short: with planes scaled so that every chamfer plane is E = (F + G − t)/2, the limit is
// C¹ if, in every hexagon E and towards either facet F beside the edge it cut, all later lifts together stay within the
// depth that the two old vertices of that edge got below F:
//
//     τ' + τ'' + τ''' + …  <=  D_F(v) = τ(FG) + τ(FH) − τ(GH)     at both ends v = FGH of the edge FG,             (B)
//
// τ being the lifts of the levels that follow, as the integers of formula (1) of the chamfer, one factor 2 a level.

/// What one chamfer step spends of the budgets (B) that steps before it have left, and how flat its level is.
struct SmoothLevel {
  std::uint32_t level = 0;        ///< the level that the step makes
  double largest_share = 0;       ///< upper bound of lift / what was left of its budget; 0: no budget was touched
  /// Upper bound, degrees, of the angles between neighbouring facets of the level.
  double angle_bound_deg = 0;
  /// s for which the angles θ between neighbours k levels later have sin(θ/2) <= s / 2^k; infinity where some three
  /// normals at a vertex are not pairwise acute.
  double later_sine = 0;
};

struct SmoothLimit {
  /// proved: the last levels are chamfer steps that keep (B), so that every continuation that keeps it has a C¹ limit.
  /// undecided: something of this does not hold, which says nothing about the limit. Never refuted.
  Verdict verdict = Verdict::undecided;
  std::string reason;               ///< why it is undecided, with the element
  std::vector<SmoothLevel> levels;  ///< of the chamfer steps, while they could be followed
};

/// Decides (B) with exact integers for the chamfer steps at the end of the levels of `body`, found from its loops and
/// addresses alone. Cost: linear but for a sort per level; about a third more than proving the body convex.
[[nodiscard]] SmoothLimit smooth_limit(const PlaneBody& body, const ProgressPart& progress = {});

}  // namespace hexact
