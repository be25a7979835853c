// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/cut_policy.hpp"
#include "hexact/exact/plane_body.hpp"
#include "hexact/kernel/honeycomb_map.hpp"
#include "hexact/kernel/progress.hpp"

#include <vector>

namespace hexact {

/// One level of a planar honeycomb over an exact field S (Rational or QuadraticField).
template <class S>
struct HoneycombLevel {
  HoneycombMap map;
  std::vector<Plane<S>> planes;    ///< one per facet, in facet order
  std::vector<Point3<S>> points;   ///< one per vertex, in canonical order
};

/// Exact figures of one step.
template <class S>
struct StepFigures {
  S delta;    ///< smallest 1 − λ(a→b) − λ(b→a) over all edges, phs (16)
  S min_gap;  ///< smallest 1 − v_j − u_{j+1} over all facet corners, phs (d.1); positive for a valid step
};

template <class S>
struct HoneycombStep {
  HoneycombLevel<S> level;
  StepFigures<S> figures;
};

/// Level 0 from an exact convex trivalent body. Coordinates are file coordinates (scale and shift applied).
/// Throws InvalidInput (NotTrivalent, ...). Does not test convexity: see certify.
template <class S>
[[nodiscard]] HoneycombLevel<S> honeycomb_start(const PlaneBody& body);

/// One planar honeycomb step: phs (b), with conditions (1), (8), (10) decided exactly first.
/// Throws InvalidInput with codes ParameterOutOfRange (edge), QuadCollapse (facet), TriangleOvercut (facet).
/// Cost: linear in the size, times the cost of numbers that grow by a factor 2 to 5 per level.
/// Source: Han, "planar hexagon corner cutting", Chinese Journal of Computers 47(7), 2024, eqs. (1)-(10).
template <class S>
[[nodiscard]] HoneycombStep<S> honeycomb_step(const HoneycombLevel<S>& level, const CutPolicy& policy,
                                              const ProgressPart& progress = {});

/// The level as a body of planes and loops, every vertex with its three defining planes.
template <class S>
[[nodiscard]] PlaneBody to_plane_body(const HoneycombLevel<S>& level);

extern template HoneycombLevel<Rational> honeycomb_start(const PlaneBody&);
extern template HoneycombLevel<QuadraticField> honeycomb_start(const PlaneBody&);
extern template HoneycombStep<Rational> honeycomb_step(const HoneycombLevel<Rational>&, const CutPolicy&,
                                                       const ProgressPart&);
extern template HoneycombStep<QuadraticField> honeycomb_step(const HoneycombLevel<QuadraticField>&, const CutPolicy&,
                                                             const ProgressPart&);
extern template PlaneBody to_plane_body(const HoneycombLevel<Rational>&);
extern template PlaneBody to_plane_body(const HoneycombLevel<QuadraticField>&);

}  // namespace hexact
