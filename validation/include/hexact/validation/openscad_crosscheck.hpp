// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/kernel/progress.hpp"
#include "hexact/validation/openscad_output.hpp"
#include "hexact/validation/scad_model.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

// OpenSCAD as a second, independent witness: it builds the same solid by its own exact Boolean operations.
namespace hexact::validation {

enum class Agreement { agree, differ, not_checked };
/// "agree", "differ" or "not-checked".
[[nodiscard]] const char* name_of(Agreement agreement) noexcept;

struct ElementCounts {
  std::size_t vertices = 0, edges = 0, facets = 0;
  friend bool operator==(const ElementCounts&, const ElementCounts&) = default;
};

/// The outcome of one route; volumes are in file units.
struct RouteReport {
  Route route = Route::intersection;
  Agreement verdict = Agreement::not_checked;
  std::string reason;                        ///< why not agree; empty when it agrees
  std::optional<ElementCounts> openscad;     ///< as printed by OpenSCAD; merged from its triangles for hull
  std::optional<double> volume_difference;   ///< |ours − theirs|, rounded to nearest
  std::optional<double> bound;               ///< what the rounding of the export can explain, exact then rounded
  double seconds = 0;                        ///< of OpenSCAD
};

struct CrosscheckReport {
  Agreement verdict = Agreement::not_checked;
  std::string reason;
  ElementCounts ours;
  std::vector<RouteReport> routes;
};

struct CrosscheckOptions {
  double time_limit = 600;                   ///< seconds, for each run of OpenSCAD
  std::size_t max_cuts = 400;                ///< half-spaces; more are not run
  std::string openscad = "openscad";         ///< found by PATH unless it has a slash
  std::vector<Route> routes = {Route::intersection};
};

/// Rebuilds the body by each route and compares: printed counts equal; each exported vertex within the export's
/// rounding of exactly one of ours and vice versa; triangles merged by incidence with our exact planes into as many
/// facets and edges; volume and bounding box within the bound that follows. `differ` as soon as one route differs,
/// `agree` when all agree; a missing, failing or hanging OpenSCAD is `not_checked`, never agreement.
/// Precondition: a convex body. Throws InvalidInput as scad_model does; over Q(√5) the answer is not_checked.
[[nodiscard]] CrosscheckReport crosscheck_openscad(const PlaneBody& body, const CrosscheckOptions& options = {},
                                                   const ProgressPart& progress = {});

/// Vertices, edges and facets of a body.
[[nodiscard]] ElementCounts element_counts(const PlaneBody& body);

/// Compares an exported mesh with the model, filling verdict, reason, bound and volume difference, and the merged
/// counts where `report.openscad` is empty. Everything is decided with rational arithmetic.
[[nodiscard]] RouteReport compare_export(const ScadModel& model, const OpenscadMesh& mesh, const ElementCounts& ours,
                                         RouteReport report);

/// Seconds that OpenSCAD 2021.01 is expected to take: 13 s for 326 half-spaces growing with the power 1.93,
/// measured on honeycomb levels 1 to 4 of the cube.
[[nodiscard]] double openscad_cost_seconds(std::size_t half_spaces);

}  // namespace hexact::validation
