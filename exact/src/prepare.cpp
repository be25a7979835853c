// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/prepare.hpp"

#include "hexact/exact/body_from_soup.hpp"
#include "hexact/exact/convex_hull.hpp"
#include "hexact/exact/corner_cut.hpp"
#include "hexact/exact/dual.hpp"
#include "hexact/exact/fit_planes.hpp"
#include "hexact/exact/merge_coplanar.hpp"
#include "hexact/exact/snap_planes.hpp"
#include "hexact/exact/triangulate.hpp"
#include "hexact/exact/truncate.hpp"

#include <cmath>
#include <limits>

namespace hexact {
namespace {

double sum_rounded_up(double x, double y) {
  if (x == 0) return y;
  return y == 0 ? x : std::nextafter(x + y, std::numeric_limits<double>::infinity());
}

FittedSoup fitted(const PolygonSoup<Rational>& soup) { return fit_planes(soup); }

/// Numbers with √5 never come from rounding: such a mesh is exact, or wrong.
struct ExactSqrt5 {
  PolygonSoup<QuadraticField> soup;
  double max_displacement = 0;
};
ExactSqrt5 fitted(const PolygonSoup<QuadraticField>& soup) {
  SoupShape shape = examine_soup(soup);
  if (!shape.findings.empty()) throw InvalidInput(std::move(shape.findings));
  return {soup, 0};
}

template <class S>
PreparedMesh prepare_over(PolygonSoup<S> soup, const PrepareOptions& options, const ProgressPart& progress) {
  PreparedMesh result;
  progress.check();
  if (options.merges_first()) {
    MergedSoup<S> merged = merge_coplanar(soup);
    soup = std::move(merged.soup);
    result.merged_facets = merged.merged_facets;
    result.dropped_vertices = merged.dropped_vertices;
  }
  progress.report(0.2);
  if (options.fit_planes) {
    auto fit = fitted(soup);
    soup = std::move(fit.soup);
    result.max_displacement = fit.max_displacement;
  }
  progress.report(0.5);
  if (options.hull) soup = convex_hull(soup.points);
  progress.report(0.8);
  if (options.truncate) {
    TruncatedSoup<S> truncated = truncate_vertices(soup, *options.truncate);
    soup = std::move(truncated.soup);
    result.truncated_vertices = truncated.truncated_vertices;
  }
  if (options.dual) soup = dual_mesh(soup);
  if (options.corner_cut) soup = corner_cut_mesh(soup, *options.corner_cut);
  if (options.triangulate) soup = triangulate(soup);
  progress.report(0.9);
  if (options.snap_bits) {
    SnappedBody snapped = snap_planes(soup, *options.snap_bits);
    result.max_displacement = sum_rounded_up(result.max_displacement, snapped.max_displacement);
    result.soup = rational_soup(snapped.body);
    result.body = std::move(snapped.body);
  } else {
    result.soup = std::move(soup);
  }
  return result;
}

}  // namespace

PreparedMesh prepare(const ExactSoup& soup, const PrepareOptions& options, const ProgressPart& progress) {
  return std::visit([&](const auto& given) { return prepare_over(given, options, progress); }, soup);
}

}  // namespace hexact
