// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/midedge_facet_limits.hpp"
#include "subdivide.hpp"

namespace hexact::app {

/// Writes the limit of every facet's centre to `--limit-points`: what the numbers of the level go to, taken for exact.
/// Throws ResourceLimit, FileError.
void write_midedge_limits(const SubdivideOptions& options, const MidedgeLevel<Rational>& level, const MidedgeLimitPlan& plan);

}  // namespace hexact::app
