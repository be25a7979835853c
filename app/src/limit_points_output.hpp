// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/cut_policy.hpp"
#include "hexact/kernel/progress.hpp"
#include "refinement.hpp"
#include "subdivide.hpp"

#include <optional>
#include <string>

namespace hexact::app {

/// Writes the document of kind `limit-points`: for each facet a point, its plane and bounds of where the limit point is.
/// `policy` is that of all further levels, where it is known.
void write_limit_points(const std::string& path, const Refinement& refinement, const SubdivideOptions& options,
                        const std::optional<SizePolicy>& policy, const ProgressPart& progress);

}  // namespace hexact::app
