// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "characteristic_net.hpp"
#include "hexact/exact/characteristic_ring.hpp"

namespace hexact {

/// A polynomial piece of the characteristic map by its Bernstein coefficients. On the unit square the coefficient of
/// B_i(x) B_j(y) stands at (i, j), i, j <= degree; on the unit triangle that of x^i y^j (1−x−y)^(degree−i−j), i + j <= degree.
struct BernsteinPiece {
  int degree = 0;
  bool triangle = false;
  std::vector<ComplexInterval> coefficients;  ///< at i · (degree + 1) + j; unused places of a triangle are 0
  [[nodiscard]] const ComplexInterval& at(int i, int j) const { return coefficients[static_cast<std::size_t>(i * (degree + 1) + j)]; }
};

/// The pieces of one half of sector 0 of the ring, and those that the bisector of the sector maps to themselves:
/// biquadratic (doo-sabin), bicubic (catmull-clark) or quartic box splines (loop).
[[nodiscard]] std::vector<BernsteinPiece> ring_pieces(SpectrumScheme scheme, const CharacteristicNet& net);

/// As `prove_ring` for the schemes of B-splines.
[[nodiscard]] RingProof prove_bernstein_ring(const std::vector<BernsteinPiece>& pieces);

}  // namespace hexact
