// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/rational.hpp"

#include <optional>
#include <vector>

namespace hexact {

/// Weights c >= 0 of least sum with y <= Σ c_i points[i] in every entry.
struct Cover {
  Rational total;
  std::vector<Rational> weights;
};

/// None if no weights do it: some entry of y is positive and 0 in all points. Simplex method over Q on the dual
/// problem, max y·x with x >= 0 and points[i]·x <= 1, by Bland's rule, which never cycles.
/// Precondition: points and y are non-negative, of equal length. Cost: exponential in the worst case; 4 entries and
/// 12 points take some ten pivots.
[[nodiscard]] std::optional<Cover> least_cover(const std::vector<Rational>& y, const std::vector<std::vector<Rational>>& points);

}  // namespace hexact
