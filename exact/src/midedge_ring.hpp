// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "characteristic_net.hpp"
#include "hexact/exact/characteristic_ring.hpp"

namespace hexact {

/// The control net of the characteristic map after `level` double steps: side × side points, row i · side + j.
struct RefinedNet {
  int side = 0;
  int valence = 0;
  std::vector<ComplexInterval> points;
  /// Continued over the sides of the sector; not both i and j are negative.
  [[nodiscard]] ComplexInterval at(int i, int j) const;
};

/// The 4 × 4 weights (row by row) of a fine vertex (2a+1, 2b+1) on the coarse vertices (a−1 … a+2, b−1 … b+2) far from
/// the k-gon; those of the others are mirror images.
[[nodiscard]] std::array<Rational, 16> regular_weights(SpectrumScheme scheme);

[[nodiscard]] RefinedNet refined_net(SpectrumScheme scheme, const SubdivisionMatrix& matrix, const CharacteristicNet& net,
                                     const RationalInterval& eigenvalue, int level);

/// As `prove_ring` for midedge and midedge6 at one level.
[[nodiscard]] RingProof prove_midedge_ring(SpectrumScheme scheme, const RefinedNet& net, int level);

}  // namespace hexact
