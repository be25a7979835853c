// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/eigenvalues.hpp"
#include "interval.hpp"

#include <vector>

namespace hexact {

/// A number that the roots of a monic polynomial p do not exceed in modulus, but for one root in each of the disjoint
/// `isolated` intervals, at whose ends p changes sign. Divides these roots out in interval arithmetic and finds the
/// radius by the test of Schur and Cohn; a multiple of 2^-16, or Cauchy's bound when no smaller one can be proved.
[[nodiscard]] Rational remaining_root_bound(const std::vector<Interval>& p, const std::vector<RationalInterval>& isolated);

}  // namespace hexact
