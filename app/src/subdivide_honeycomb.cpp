// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/io/mesh_file.hpp"
#include "hexact/io/parameters_file.hpp"
#include "lift_choice.hpp"
#include "refinement_run.hpp"
#include "subdivide.hpp"

#include <fmt/format.h>

namespace hexact::app {
namespace {

void check_combination(const SubdivideOptions& options) {
  if (!options.certificate.empty() && options.arithmetic == "double") {
    throw UsageError("--certificate needs an exact arithmetic, not --arithmetic double");
  }
  if (options.arithmetic == "double" && output_format(options.output, options.to) == io::Format::planes) {
    throw UsageError("doubles have no exact planes; write a mesh, or use another --arithmetic");
  }
  if (options.then.empty()) {
    if (!options.lifts.empty() || !options.keep.empty()) throw UsageError("--lifts and --keep need --then chamfer:K, or --scheme chamfer");
  } else if (options.arithmetic != "snapped" && options.arithmetic != "rational") {
    throw UsageError("--then chamfer:K needs rational planes: --arithmetic snapped or rational");
  }
}

/// The points of the body that a file describes, for planes tangent to their convex hull.
std::vector<Point3<double>> points_of(const std::string& path) {
  const io::Geometry geometry = io::read_geometry(path);
  if (const auto* body = std::get_if<PlaneBody>(&geometry)) return rounded_vertices(*body).points;
  if (const auto* certificate = std::get_if<Certificate>(&geometry)) return rounded_vertices(certificate->body).points;
  std::vector<Point3<double>> points;
  for (const auto& p : std::get<PolygonSoup<Rational>>(geometry).points) {
    points.push_back({p.x.to_double(), p.y.to_double(), p.z.to_double()});
  }
  return points;
}

/// Policies that read a file, and those that are a text alone.
PolicySchedule schedule_of(const std::string& text, Arithmetic arithmetic, const PlaneBody& base) {
  constexpr std::string_view kFile = "file=", kTangent = "tangent=";
  if (text.starts_with(kFile)) {
    return document_policy(io::read_parameters(text.substr(kFile.size())), arithmetic, base);
  }
  if (text.starts_with(kTangent) && text != "tangent=sphere" && text != "tangent=ellipsoid") {
    return [policy = CutPolicy(tangent_policy(points_of(text.substr(kTangent.size()))))](const HoneycombMap&) { return policy; };
  }
  try {
    return parse_policy(text, arithmetic, base);
  } catch (const InvalidInput& e) {  // values out of range are about the solid; a policy that is none is not
    if (e.code() == "BadParameters") throw UsageError(e.what());
    throw;
  }
}

}  // namespace

Outcome subdivide_honeycomb(const SubdivideOptions& options, const Common& common) {
  check_combination(options);
  check_output(options);
  RefinementPlan plan;
  plan.honeycomb_levels = options.levels;
  plan.chamfer_levels = chamfer_levels(options.then);
  const BodyInput input = read_convex(options);
  check_bounds(input.body, plan, common);
  const Arithmetic arithmetic = arithmetic_named(options.arithmetic);
  plan.schedule = schedule_of(options.parameters, arithmetic, input.body);
  plan.provenance = fmt::format("--parameters {} --arithmetic {}", options.parameters, options.arithmetic);
  plan.schedule_is_lasting = !options.parameters.starts_with("file=");  // single levels of a file may differ
  if (plan.chamfer_levels > 0) {
    plan.lifts = lift_choice(options, options.levels);
    plan.provenance += fmt::format(" --then {} {}", options.then, lift_provenance(options));
  }
  return run_refinement(input, Refinement(input.body, arithmetic, options.bits), plan, options, common);
}

}  // namespace hexact::app
