// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/eigenvalues.hpp"
#include "interval.hpp"
#include "sector_place.hpp"

#include <optional>
#include <vector>

namespace hexact {

/// The eigenvector of mode 1: complex control points of sector 0, those of sector s being e^{2πi s/k} times these.
/// Turned so that the middle of sector 0 is the positive real axis, and the first vertex has modulus 1.
class CharacteristicNet {
 public:
  CharacteristicNet(SectorLattice lattice, int valence, std::vector<std::array<int, 2>> vertices, std::vector<ComplexInterval> points);
  /// The control point at coordinates of sector 0 continued over its sides. Precondition: it is one of the net's.
  [[nodiscard]] ComplexInterval at(int i, int j) const;
  [[nodiscard]] int valence() const noexcept { return valence_; }

 private:
  SectorLattice lattice_;
  int valence_;
  int side_;                        ///< i, j < side_
  std::vector<std::size_t> number_; ///< of (i, j) at i · side_ + j
  std::vector<ComplexInterval> points_;
  std::vector<ComplexInterval> turns_;  ///< e^{2πi s/k} for s = −1, 0, 1, 2
};

/// Encloses the eigenvector of mode 1 for the one eigenvalue in `eigenvalue`. Solves (M − λ) u = 0 without one row by
/// Gaussian elimination in complex intervals; when all pivots exclude 0, the solution is unique and enclosed. Nothing
/// when a pivot is not certain, or the first vertex may be 0.
[[nodiscard]] std::optional<CharacteristicNet> characteristic_net(const SubdivisionMatrix& matrix, const RationalInterval& eigenvalue);

}  // namespace hexact
