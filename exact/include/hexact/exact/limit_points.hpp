// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/cut_policy.hpp"
#include "hexact/exact/plane_body.hpp"
#include "hexact/kernel/honeycomb_map.hpp"
#include "hexact/kernel/progress.hpp"

#include <optional>
#include <vector>

namespace hexact {

/// Where a facet's polygons shrink to. Every later level keeps a polygon of the facet inside the present one, so the
/// limit lies in all of them.
struct LimitPoint {
  Point3<double> point;          ///< in file coordinates, rounded
  double radius = 0;             ///< upper bound of the distance from `point` to any point of the present polygon
  std::optional<double> bound;   ///< upper bound of the distance to the limit point under the policy, if one was given
};

/// The limit point of every facet under a size policy that goes on unchanged, or, without one, the mean of its corners.
///
/// A facet's next polygon depends on the present one and on the parameters of its own edges alone (phs b.1), and behind
/// the next step all its neighbours are hexagons. So each facet is refined by itself, with intervals of 256 to 4096
/// bits, until the enclosures of its corners are within 2^-56 of its size or as fine as doubles. With λ = 0 this is
/// the pentagram map, whose limit is Glick's point (b.4).
/// `bound` is missing where the policy would be refused, on this level (conditions (1), (8), (10)) or on a later one.
/// Precondition: the body is the level of the map, convex. Cost: about 1 ms for a facet; in parallel; the result does not
/// depend on the number of threads.
[[nodiscard]] std::vector<LimitPoint> limit_points(const HoneycombMap& map, const PlaneBody& body,
                                                   const std::optional<SizePolicy>& policy,
                                                   const ProgressPart& progress = {});

}  // namespace hexact
