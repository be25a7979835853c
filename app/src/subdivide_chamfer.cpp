// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/exact/body_from_soup.hpp"
#include "lift_choice.hpp"
#include "refinement_run.hpp"
#include "subdivide.hpp"
#include "subdivide_chamfer_surface.hpp"

namespace hexact::app {
namespace {

struct ToSurface {
  PlaneBody operator()(const PolygonSoup<Rational>& soup) const { return body_from_soup(soup, SoupRule::planar); }
  PlaneBody operator()(PlaneBody& body) const { return std::move(body); }
  PlaneBody operator()(Certificate& certificate) const { return std::move(certificate.body); }
};

/// Any surface of planar facets; polygons have to be closed.
BodyInput read_surface(const SubdivideOptions& options) {
  io::Geometry geometry = io::read_geometry(options.input, named_format(options.from));
  return {std::visit(ToSurface{}, geometry), options.input};
}

}  // namespace

Outcome subdivide_chamfer(const SubdivideOptions& options, const Common& common) {
  check_output(options);
  RefinementPlan plan;
  plan.chamfer_levels = options.levels;
  plan.lifts = lift_choice(options, 0);
  plan.provenance = lift_provenance(options);
  const BodyInput input = read_surface(options);
  if (!convex_trivalent_findings(input.body).empty()) return subdivide_chamfer_surface(input, options, common);
  check_bounds(input.body, plan, common);
  return run_refinement(input, Refinement(chamfer_start(input.body, plan.lifts.factors)), plan, options, common);
}

}  // namespace hexact::app
