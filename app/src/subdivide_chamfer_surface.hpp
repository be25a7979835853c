// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "body_input.hpp"
#include "subdivide.hpp"

namespace hexact::app {

/// `subdivide --scheme chamfer` on what is no convex solid: any surface of planar facets with three planes at every
/// vertex, docs/chamfer-nonconvex.md. A certificate claims closed and trivalent (without a boundary), planar and
/// embedded; where embedded is refuted the result is written without it, with the witness in the report and exit 1.
/// Throws UsageError for options of convex solids, what chamfer_surface_start throws, ResourceLimit.
[[nodiscard]] Outcome subdivide_chamfer_surface(const BodyInput& input, const SubdivideOptions& options, const Common& common);

}  // namespace hexact::app
