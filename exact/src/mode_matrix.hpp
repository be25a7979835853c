// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/subdivision_matrix.hpp"
#include "interval.hpp"

#include <cstddef>
#include <map>
#include <vector>

namespace hexact {

/// A finite sum of weights · z^exponent.
using Laurent = std::map<int, Rational>;

/// The block of a subdivision matrix on the vectors u with u(s) = z^s u(0), z = e^{2πi m/k}, entries as Laurent
/// polynomials of z. Mode 0 has the central vertex, if there is one, as its last row and column, and its entries are
/// numbers of Q(cos 2π/k), written with z = e^{2πi/k}.
struct ModeMatrix {
  std::size_t n = 0;
  int angle = 0;  ///< z = e^{2πi angle/k}: the mode, or 1 in mode 0
  std::vector<Laurent> entries;
  [[nodiscard]] const Laurent& at(std::size_t r, std::size_t c) const { return entries[r * n + c]; }
};

/// Precondition: 0 <= mode <= k/2. Uses Σ_d z^d = 0 and Σ_d cos(2πd/k) z^d = k/2 for modes ±1 and 0 for the others.
[[nodiscard]] ModeMatrix mode_matrix(const SubdivisionMatrix& matrix, int mode);

/// The sets of rows that depend on each other; behind each stand only sets that depend on it or that are unrelated.
/// The characteristic polynomial of the matrix is the product of those of its diagonal blocks on these sets.
[[nodiscard]] std::vector<std::vector<std::size_t>> dependent_sets(const ModeMatrix& matrix);

}  // namespace hexact
