// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/exact/snapped_honeycomb.hpp"
#include "hexact/kernel/edge_numbering.hpp"

#include <cstdint>
#include <functional>
#include <span>
#include <variant>
#include <vector>

namespace hexact {

// The exact chamfer: every edge is cut by a plane parallel to it. With facet planes F = (n, d), n·x <= d, scaled to
// normals of nearly equal length, the edge between F and G gets
//
//     E = F + G − τ·(0, 0, 0, 1),          τ > 0 its lift,                                                      (1)
//
// and all older planes are doubled for the next level. Every facet keeps its sides, every edge becomes a hexagon.
// The result is a strictly convex polyhedron with exactly that lattice if and only if
//   1. at every vertex the three lifts satisfy the strict triangle inequalities,
//   2. every side of every facet, moved in by the lifts (n_G·x <= d_G − τ in the facet F), keeps a positive length.
// docs/chamfer.md proves it. Both are decided exactly.

/// One level of an exact chamfer.
struct ChamferLevel {
  /// Map, planes, approximate points with proven errors, and frame. A plane keeps for ever the integers that it was
  /// made with; `coefficient` times it is the scaled plane F of the formulas.
  SnappedLevel surface;
  std::vector<Integer> factors;  ///< of the planes that the chamfer started from, without a common divisor
  /// weights[0] multiplies those planes, weights[k] the planes of chamfer step k: 2 for every step since, and the
  /// multipliers that steps have needed to make their lifts integers.
  std::vector<Integer> weights;
  double unit_mantissa = 1;      ///< scaled normals are about unit_mantissa·2^unit_exponent long
  long unit_exponent = 0;
  Integer normal_bound, offset_bound;  ///< upper bounds of |a|, |b|, |c| and of |d| of the scaled planes

  [[nodiscard]] std::size_t start_facets() const noexcept { return factors.size(); }
};

/// What scaled planes are made from: F = coefficient · plane of facet f.
[[nodiscard]] Integer coefficient(const ChamferLevel& level, std::uint32_t f);
/// The scaled plane F of formula (1).
[[nodiscard]] Plane<Integer> scaled_plane(const ChamferLevel& level, std::uint32_t f);
/// All scaled normals over their common length: nearly unit vectors. Cost: linear, in parallel.
[[nodiscard]] RawVector<Point3<double>> scaled_normals(const ChamferLevel& level);

/// Lifts that floating point proposes: τ over the common length of the scaled normals, in the coordinates of the
/// level's points. They are rounded down to integers; where the smallest would have fewer than 12 bits (24 at the first
/// step, to spare later ones), all scaled planes are multiplied by a power of two first.
struct ProposedLifts {
  RawVector<double> lengths;  ///< by the number of the edge
};
/// Lifts that are said exactly, in the scale of the input: with κ the factors of `lift_scale`, F its planes with
/// coprime integers in file coordinates, k chamfer steps before, E = 2^k κ_F F + … − τ.
struct ExactLifts {
  std::vector<Rational> values;  ///< by the number of the edge
};
using Lifts = std::variant<ProposedLifts, ExactLifts>;

/// Gives the lifts of the edges of a level; called once for each step. See lift_rules.hpp.
using LiftRule = std::function<Lifts(const ChamferLevel&, const EdgeNumbering&)>;

/// How the planes at the start are scaled, in terms that do not depend on their representation.
struct LiftScale {
  /// κ, coprime integers: scaled plane in file coordinates = unit · κ_f · (coprime integers of plane f), at the start.
  std::vector<Integer> factors;
  /// Integer lift of the level = exact lift · unit, in the frame of the level.
  Rational unit;
};
/// Scaling of a level (the factors are those of its start). Cost: linear in the planes of the start.
[[nodiscard]] LiftScale lift_scale(const ChamferLevel& level);

/// Level 0 of a chamfer, or of chamfer steps behind honeycomb steps. Without `factors` (κ above, one for each facet),
/// planes are scaled by the smallest power of two times integers that makes all normals equally long to 2^-12.
/// Precondition: a convex body. Throws InvalidInput (FieldNotRational, NotTrivalent, DegenerateVertex; BadLifts for
/// factors that are not one positive number for each facet; NotConvex naming the first violated signs).
[[nodiscard]] ChamferLevel chamfer_start(SnappedLevel base, std::span<const Rational> factors = {});
[[nodiscard]] ChamferLevel chamfer_start(const PlaneBody& body, std::span<const Rational> factors = {});

/// One chamfer step. Decides conditions 1 and 2 exactly; throws InvalidInput with all violations (at most 16 each):
/// BadLifts (wrong count), LiftNotPositive (edge), TriangleInequality (vertex), SideCollapse (edge, with the facet).
/// Takes the level by value: pass std::move to save memory. Cost: linear, in 64-bit integers while scaled planes fit
/// 62 bits, one bit more a step; in parallel, the result does not depend on the number of threads.
[[nodiscard]] ChamferLevel chamfer_step(ChamferLevel level, const LiftRule& rule);

}  // namespace hexact
