// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/subdivision_matrix.hpp"
#include "hexact/exact/symbol.hpp"
#include "hexact/kernel/midedge.hpp"

#include <vector>

namespace hexact {

/// Σ a(v) z^v of a scheme on its regular mesh, where the fine vertex f has the weight a(f − 2c) of the coarse vertex c.
/// Taken from the rows of its matrix at valence 4 (6 for `loop`): all of them, the central ones too, are found to be
/// rows of one mask. Vertices are those of Z²; in triangles (0, 1) and (1, −1) are the other neighbours of 0. A step is
/// a double one for the Midedge schemes, and in dual schemes f and c are corners with centres at f/2 + 1/4 and c + 1/2.
[[nodiscard]] Symbol regular_symbol(SpectrumScheme scheme);

/// The symbol of one single Midedge step on quadrilaterals: old vertices have even coordinates, and the new vertex p
/// has the weight a(p − c) of the old vertex c. Taken from the step itself on unit data.
[[nodiscard]] Symbol midedge_step_symbol(MidedgeRule rule);

/// p(z², w²) p(zw, z/w), the second step being the first one turned by 45° and shrunk by √2: on a lattice twice as fine,
/// so that the coefficient of z^(2a−1) w^(2b−1) is that of z^a w^b in `regular_symbol`.
[[nodiscard]] Symbol double_step_symbol(const Symbol& step);

/// symbol = 4 · Π (1 + z^ξ)/2 · smoothing · z^shift, with as many factors as there are in the four directions of axes
/// and diagonals, and the terms of `smoothing` centred at 0.
struct BoxSplineFactors {
  std::vector<Symbol::Vector> directions;  ///< with multiplicity, (1,0), (0,1), (1,1), (1,−1) in this order
  Symbol smoothing;                        ///< 1 for a box spline
  Symbol::Vector shift{};
};
[[nodiscard]] BoxSplineFactors box_spline_factors(const Symbol& symbol);
/// The product above.
[[nodiscard]] Symbol product(const BoxSplineFactors& factors);

/// The least number of directions whose removal leaves none, or parallel ones. The box spline is C^(n−2), its
/// derivatives of this order are Lipschitz continuous, and it is not C^(n−1) (de Boor and Höllig 1983).
[[nodiscard]] int removal_number(const std::vector<Symbol::Vector>& directions);

}  // namespace hexact
