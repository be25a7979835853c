// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/cut_policy.hpp"
#include "hexact/exact/plane_body.hpp"
#include "hexact/kernel/errors.hpp"
#include "hexact/kernel/honeycomb_map.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace hexact {

/// One level of a planar honeycomb with integer planes of locally adapted width.
///
/// A cut plane is rounded outward to a few bits and *is* the plane from then on, so every level is an exact
/// honeycomb step with slightly larger parameters than asked. Cost per facet is bounded at every depth.
struct SnappedLevel {
  HoneycombMap map;
  IntegerPlanes planes;                 ///< one per facet, in facet order; never modified by later levels
  RawVector<Point3<double>> points;     ///< approximate vertices in the coordinates of the planes
  /// Proven bound of |approximate − exact| for each vertex; a finite bound also says that the normals of its facets
  /// (in the order of `facets_at`) have a positive determinant, infinity says nothing.
  RawVector<float> errors;
  long scale = 0;                       ///< file coordinate = 2^scale · coordinate here + shift
  std::array<Rational, 3> shift{};
};

struct SnappedOptions {
  /// Bits by which the rounding of a plane stays below the depth of its cut, where narrow words allow; bits, 8…64.
  int guard_bits = 16;
  /// Upper bound on the bits of a normal's coefficient; 0: none. A plane that needs more ends the work.
  int max_bits = 0;
};

/// Proven bounds about one step.
struct SnappedFigures {
  double max_parameter_change = 0;  ///< upper bound of λ realised − λ asked (0 for plane policies)
  double min_parameter = 0;         ///< lower bound of the smallest realised λ
  double delta = 0;                 ///< lower bound of 1 − λ(a→b) − λ(b→a) over all edges (size policies)
  std::size_t exact_choices = 0;    ///< planes chosen in 128-bit words or big integers because doubles could not tell
};

struct SnappedStep {
  SnappedLevel level;
  SnappedFigures figures;
};

/// Level 0. The planes stay exactly those of `body`; only the coordinate frame is scaled by a power of two and
/// shifted by a dyadic vector so that the body fits the working range.
/// Throws InvalidInput (NotTrivalent, …); convexity is a precondition (see `sign_violations`).
[[nodiscard]] SnappedLevel snapped_start(const PlaneBody& body);

/// One honeycomb step. The parameters that are asked are checked exactly against conditions (1), (8), (10) of
/// Han 2024 first (InvalidInput: ParameterOutOfRange, QuadCollapse, TriangleOvercut); the realised ones are
/// never smaller than those asked, and no old vertex but its own is cut off by a new plane (plane policies:
/// only that the own vertex is cut off). The result still has to pass `sign_violations`.
/// Takes the level by value: pass std::move to save memory. Throws ResourceLimit naming level and vertex when
/// options.max_bits is not enough. Cost: linear; the result does not depend on the number of threads.
[[nodiscard]] SnappedStep snapped_step(SnappedLevel level, const CutPolicy& policy, const SnappedOptions& options);

/// What the signs of a level refute.
struct SignViolation {
  enum class Kind { corner, edge, turning } kind = Kind::corner;
  std::uint32_t element = 0;  ///< vertex, half-edge or facet
};

/// Decides local strict convexity exactly: det3 > 0 at every vertex, det4 > 0 at every edge, every facet turns
/// once. With a connected closed map of Euler characteristic 2 these signs prove that the level bounds a convex
/// body (van Heijenoort 1952). Returns the violations in order, at most `limit`; empty: proved.
/// Cost: 2 det3 and 3 det4 per facet, in 128-bit words where operands fit.
[[nodiscard]] std::vector<SignViolation> sign_violations(const HoneycombMap& map, const IntegerPlanes& planes,
                                                         std::size_t limit = 16);

/// The same signs, decided by the points of the level and their proven errors where these are small enough, and
/// exactly where not: several times faster.
[[nodiscard]] std::vector<SignViolation> sign_violations(const SnappedLevel& level, std::size_t limit = 16);

/// What a violation means for the step that made the level, as InvalidInput would name it: TriangleOvercut or
/// QuadCollapse (facet), EdgeCollapse (edge of the level before), NotConvex.
[[nodiscard]] Finding explain(const SignViolation& violation, const HoneycombMap& map);

/// The level as a body; shares nothing with it.
[[nodiscard]] PlaneBody to_plane_body(const SnappedLevel& level);

}  // namespace hexact
