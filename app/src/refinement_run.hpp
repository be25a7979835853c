// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "body_input.hpp"
#include "lift_choice.hpp"
#include "refinement.hpp"
#include "subdivide.hpp"

#include <string>

namespace hexact::app {

/// Honeycomb steps, then chamfer steps.
struct RefinementPlan {
  unsigned honeycomb_levels = 0;
  PolicySchedule schedule;
  bool schedule_is_lasting = false;  ///< levels beyond the last would be cut alike
  unsigned chamfer_levels = 0;
  LiftChoice lifts;
  std::string provenance;  ///< options beyond scheme and levels, for certificates

  [[nodiscard]] unsigned levels() const noexcept { return honeycomb_levels + chamfer_levels; }
};

/// Refuses outputs that cannot be: unknown formats, patterns without a level. Throws UsageError.
void check_output(const SubdivideOptions& options);
/// Reads the input. Throws InvalidInput with all findings where it is no convex solid with three facets at every vertex.
[[nodiscard]] BodyInput read_convex(const SubdivideOptions& options);
/// Throws ResourceLimit for work that would pass the bounds, before it starts.
void check_bounds(const PlaneBody& body, const RefinementPlan& plan, const Common& common);

/// Carries out the plan and writes everything that the options ask for.
[[nodiscard]] Outcome run_refinement(const BodyInput& input, Refinement start, const RefinementPlan& plan,
                                     const SubdivideOptions& options, const Common& common);

}  // namespace hexact::app
