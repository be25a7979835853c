// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "geometry_output.hpp"
#include "hexact/exact/prepare.hpp"

#include <optional>

namespace hexact::app {

/// The exact polygons of what a file holds, over the field it uses.
[[nodiscard]] ExactSoup exact_soup(io::Geometry&& geometry);

/// Writes exact polygons: as `.planes` without loss (`body` if given, else their planes), otherwise with every
/// coordinate correctly rounded. Throws what write_geometry and body_from_soup throw.
WrittenGeometry write_exact(const OutputChoice& output, const ExactSoup& soup, const std::optional<PlaneBody>& body,
                            const ProgressPart& progress);

/// Says on standard error that the file does not hold the exact result, unless it does or --quiet is given.
void remark_rounding(const char* subcommand, const WrittenGeometry& written, const Common& common);

}  // namespace hexact::app
