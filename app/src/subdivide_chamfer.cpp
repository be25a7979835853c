// SPDX-License-Identifier: GPL-3.0-or-later
#include "lift_choice.hpp"
#include "refinement_run.hpp"
#include "subdivide.hpp"

namespace hexact::app {

Outcome subdivide_chamfer(const SubdivideOptions& options, const Common& common) {
  check_output(options, common);
  RefinementPlan plan;
  plan.chamfer_levels = options.levels;
  plan.lifts = lift_choice(options, 0);
  plan.provenance = lift_provenance(options);
  const BodyInput input = read_convex(options);
  check_bounds(input.body, plan, common);
  return run_refinement(input, Refinement(chamfer_start(input.body, plan.lifts.factors)), plan, options, common);
}

}  // namespace hexact::app
