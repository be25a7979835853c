// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/chamfer.hpp"
#include "subdivide.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace hexact::app {

/// How the edges of chamfer steps are lifted, and how the planes before the first are scaled.
struct LiftChoice {
  LiftRule rule;
  std::vector<Rational> factors;  ///< empty: by the rule of `chamfer_start`
};

/// What --lifts and --keep say; the first chamfer step cuts the edges of level `start`. Throws UsageError for texts that
/// name nothing, and what reading a document throws.
[[nodiscard]] LiftChoice lift_choice(const SubdivideOptions& options, std::uint32_t start);
/// The same as options of the command line.
[[nodiscard]] std::string lift_provenance(const SubdivideOptions& options);
/// K of --then chamfer:K; 0 when the text is empty. Throws UsageError.
[[nodiscard]] unsigned chamfer_levels(const std::string& then);

}  // namespace hexact::app
