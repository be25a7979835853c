// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/midedge_facet_limits.hpp"
#include "subdivide.hpp"

#include <span>

namespace hexact::app {

/// Writes the limit of every facet's centre to `--limit-points`: what the numbers of the level go to, taken for exact.
/// `addresses` are those of its facets. Throws ResourceLimit, FileError, Cancelled.
void write_midedge_limits(const SubdivideOptions& options, const MidedgeLevel<Rational>& level, std::span<const FacetAddress> addresses,
                          const MidedgeLimitPlan& plan, const ProgressPart& progress);

}  // namespace hexact::app
