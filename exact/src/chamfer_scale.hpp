// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "cut_levels.hpp"

#include <optional>
#include <vector>

// The last steps of a body that cut edges, and the scale in which their planes are means: E = (F + G − t)/2.
namespace hexact::detail {

/// The body before its last `steps` steps, all of which cut edges; loops are read back from the hexagons, and nothing is
/// promised about them before they are replayed.
struct ChamferStart {
  PlaneBody body;
  std::uint32_t steps = 0;
  std::uint32_t first = 0;  ///< the level that the first of these steps makes
};
/// Takes back steps while the planes of the last level are as many as the edges before it. Cost: linear.
[[nodiscard]] ChamferStart chamfer_start_of(const PlaneBody& body);

/// Multipliers κ > 0, κ₀ = 1, of the planes of the map for which every edge plane E behind them, in the order of edges,
/// has its normal along κ_F n_F + κ_G n_G; nullopt where a tree of edges gives none. Other edges are not tested.
[[nodiscard]] std::optional<std::vector<Rational>> mean_multipliers(const IntegerPlanes& planes, const HoneycombMap& map);

}  // namespace hexact::detail
