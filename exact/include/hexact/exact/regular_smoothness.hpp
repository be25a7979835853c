// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/mass_growth.hpp"
#include "hexact/exact/regular_symbol.hpp"

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace hexact {

/// The numbers that prove how smooth limits are where the mesh is regular; all else is made anew from the scheme's rule.
struct RegularEvidence {
  int continuity = 0;                         ///< r: limits are C^r
  std::vector<Symbol::Vector> directions;     ///< of the box spline, ordered as in `BoxSplineFactors`
  /// c with d(t) c(t) = q(t) c(t²), q and d being the weights of smoothing seen along the axes and along the diagonals;
  /// empty without smoothing.
  StepLaw link;
  std::optional<MassGrowth> growth;           ///< of q, where there is smoothing
};

/// Facts about polynomials that follow from the symbol.
struct PolynomialFacts {
  std::array<int, 3> sum_rules{};             ///< orders of the zeros at (π, 0), (0, π), (π, π)
  std::optional<int> step_sum_rules;          ///< of a single Midedge step at its one frequency, (π, 0)
  int reproduces = 0;                         ///< data of this degree and less is its own limit; not all of the next
  int generates = 0;                          ///< data of this degree and less has limits of this degree; not all of the next
  std::array<Rational, 3> quadratic_limit;    ///< data p of degree 2 has the limit p + a p_xx + b p_xy + c p_yy, mesh width 1
};

/// How smooth limits are on a regular mesh: C^r, and derivatives of order r are Hölder continuous with every exponent
/// below `exponent.lo` (and with it), and for generic data with none above `exponent.hi`; so they are not C^(r+1). Both
/// ends are 1 for box splines: Lipschitz continuous.
struct RegularSmoothness {
  SpectrumScheme scheme = SpectrumScheme::midedge6;
  Symbol symbol;                     ///< see `regular_symbol`
  std::optional<Symbol> step;        ///< of a single step, for the Midedge schemes
  BoxSplineFactors factors;          ///< of `symbol`
  StepLaw law;                       ///< q; empty without smoothing
  RegularEvidence evidence;
  RationalInterval exponent;
  PolynomialFacts polynomials;
};

/// Proves it. The theorems are in docs/regular-smoothness.md. The symbol is factored exactly; for midedge6 the rest,
/// a smoothing with positive weights, is projected and the joint spectral radius of its two matrices enclosed; the
/// exponent is −log₂ of that, rounded outward. Cost: a tenth of a second for midedge6, less for the others.
[[nodiscard]] RegularSmoothness regular_smoothness(SpectrumScheme scheme);

/// What is wrong with the evidence as a proof for this scheme; empty if nothing is. Makes the symbol anew.
[[nodiscard]] std::string regular_fault(SpectrumScheme scheme, const RegularEvidence& evidence);

/// "C^2,a" with the exponent's decimals, or "C^2,1".
[[nodiscard]] std::string class_name(const RegularSmoothness& regular);

}  // namespace hexact
