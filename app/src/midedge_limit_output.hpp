// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/midedge_limit.hpp"
#include "subdivide.hpp"

#include <vector>

namespace hexact::app {

/// How limits of a level are taken.
struct LimitPlan {
  MidedgeRule rule = MidedgeRule::six_point;
  MidedgeBoundary boundary = MidedgeBoundary::dual;
  std::size_t most_facets = 0;  ///< of the further levels that limits need; beyond it ResourceLimit
};

/// Writes the limit of every facet's centre to `--limit-points`: what the numbers of the level go to, taken for exact.
/// Throws ResourceLimit, FileError.
void write_midedge_limits(const SubdivideOptions& options, const MidedgeLevel<Rational>& level, const LimitPlan& plan);

/// Where every vertex goes: the limit of the facet that the next step makes of it. Throws InvalidInput (HasBoundary) for
/// open meshes, whose boundary vertices become no facet of known limit; ResourceLimit.
[[nodiscard]] std::vector<Point3<Rational>> midedge_vertex_limits(const MidedgeLevel<Rational>& level, const LimitPlan& plan);

}  // namespace hexact::app
