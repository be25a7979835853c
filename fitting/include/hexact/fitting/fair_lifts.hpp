// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/chamfer.hpp"
#include "hexact/exact/lift_rules.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace hexact {

/// What fair lifts make good. In all of them s_i are the lengths of the new edges and θ_i the angles across them; the
/// lengths are linear in the lifts, the angles do not depend on them.
enum class FairObjective {
  product,   ///< the largest product of all s_i: the analytic centre of the conditions of the step
  harmonic,  ///< the smallest sum of θ_i / s_i
  even,      ///< the smallest sum of squared differences of s/θ between edges that follow each other around a facet
  ratio,     ///< the largest smallest s_i / θ_i: a linear programme
};

/// All names, in the order of the enumeration.
[[nodiscard]] const std::vector<std::string>& fair_objective_names();
/// By its name. Throws InvalidInput (UnknownObjective).
[[nodiscard]] FairObjective fair_objective_named(std::string_view name);

struct FairOptions {
  FairObjective objective = FairObjective::product;
  /// Fraction of its length that every side of every facet keeps at least, 0 < keep < 1. A side whose s/θ is below half
  /// of its facet's keeps more, at most one half: its s/θ then falls no further.
  KeptFraction keep = constant_keep(0.25);
  /// No lift exceeds this share of the sum of the other two at either end, 0.95 < share < 1 (what the
  /// automatic lifts may reach to start from); the condition is < 1.
  double triangle = 0.97;
  /// Most Newton steps of one level; more are a NumericalFailure.
  int most_steps = 400;
};

/// Lifts by a convex programme over the conditions of the chamfer step, which are linear in the lifts: triangle
/// inequalities and kept sides with the margins of `options`. Solved by Newton steps on a barrier, from lifts of
/// `automatic_lifts`, with a sparse Cholesky factorization (Eigen) of one unknown for each edge. The optimum is unique
/// (of `ratio`, the point of the central path within 0.1 % of the best value): lifts have the symmetry of the level, up
/// to rounding. `even` keeps lengths from vanishing by a tenth of the logarithms of `product`. One thread; the result does
/// not depend on the number of threads.
/// Floating point proposes, `chamfer_step` decides.
///
/// The rule throws NumericalFailure where the programme is not solved; it never falls back to other lifts.
/// Cost: about ten factorizations (ratio: about sixty) of a sparse matrix with E rows and about nine entries in each; measured
/// times in docs/chamfer-lifts.md.
[[nodiscard]] LiftRule fair_lifts(FairOptions options = {});

/// What the programme of `options.objective` makes as small as it can: its sum with the barriers of the margins, or for
/// `ratio` minus the smallest s_i / θ_i. Infinite where the lifts do not keep the margins.
/// Precondition: one length for each edge.
[[nodiscard]] double fair_cost(const ChamferLevel& level, const EdgeNumbering& edges, const ProposedLifts& lifts,
                               const FairOptions& options = {});

/// What a choice of lifts makes of a level, in floating point.
struct LiftQuality {
  double least_ratio = 0, greatest_ratio = 0;  ///< of s_i / θ_i
  double least_kept = 0;                       ///< smallest part that a side keeps
  double most_triangle = 0;                    ///< largest share of a lift in the sum of the other two at a vertex
};
/// Precondition: one length for each edge.
[[nodiscard]] LiftQuality lift_quality(const ChamferLevel& level, const EdgeNumbering& edges, const ProposedLifts& lifts);

}  // namespace hexact
