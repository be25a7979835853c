// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/midedge_limit.hpp"
#include "hexact/kernel/progress.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace hexact {

/// How steps go on towards the limit.
struct MidedgeLimitPlan {
  MidedgeRule rule = MidedgeRule::six_point;
  MidedgeBoundary boundary = MidedgeBoundary::dual;
  std::size_t most_facets = 4000000;  ///< of a further level that limits need; beyond it ResourceLimit
};

/// Limits of the centres of some facets of a level, for ever refined by the rule and the policy.
///
/// Facets whose surroundings are not yet those that further steps keep are refined together with the two rings around
/// them (`midedge_part`) until they are, some thousands at a time; everything is exact.
/// - Simple rule: the mean of the corners, at once.
/// - Six-point rule, inner facets: `MidedgeLimits`.
/// - `dual`, facets that touch the boundary: `MidedgeBoundaryLimits`, a point and no normal; nothing where that has none.
/// - `close`: facets leave the boundary, so they become inner ones. A facet that stands alone draws together to its mean.
/// - `drop`: nothing for facets that touch the boundary or never get two rings away from it, but for the simple rule.
/// Precondition: different facets of the level. The result does not depend on the number of threads.
/// Throws ResourceLimit where further steps would make more than `most_facets` facets, or under `close` take more than 200
/// because a facet has more boundary vertices with two edges in a row; then the simple rule gives the mean without normal.
/// Throws Cancelled between facets, double steps, and rows of an elimination.
[[nodiscard]] std::vector<std::optional<MidedgeLimit>> midedge_facet_limits(const MidedgeLevel<Rational>& level, const MidedgeLimitPlan& plan,
                                                                           std::span<const std::uint32_t> facets,
                                                                           const ProgressPart& progress = {});

/// Where every vertex of a level goes. An inner vertex: to the limit of the facet that the next step makes of it.
/// A boundary vertex with the facets f1 … fm in its open fan:
/// - `dual`: the boundary of the limit surface passes near it through the limits of f1, e1, f2, e2, …, fm, e_i being the
///   facet that the next double step makes of the edge between two of them; it goes to the one in the middle.
/// - `close`: to the mean of its boundary loop. The loop of a level consists of the middles of the one before, which have
///   the same mean and draw together: the limit of a boundary loop is a point.
/// - `drop`: InvalidInput (HasBoundary, edge).
/// Throws ResourceLimit as above, and where a facet at the boundary has too large a net; Cancelled as above.
[[nodiscard]] std::vector<Point3<Rational>> midedge_vertex_limits(const MidedgeLevel<Rational>& level, const MidedgeLimitPlan& plan,
                                                                  const ProgressPart& progress = {});

/// Throws InvalidInput (HasBoundary, edge) where boundary vertices have no limits: open meshes under `drop`. All later levels
/// are open if this one is.
void require_vertex_limits(const MidedgeMap& map, MidedgeBoundary boundary);

}  // namespace hexact
