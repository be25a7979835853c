// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/rational.hpp"

#include <cstddef>
#include <utility>
#include <vector>

namespace hexact {

/// A polynomial over Q: the coefficient of the i-th power stands at place i, and the last one is not 0.
using Polynomial = std::vector<Rational>;

/// Drops leading zeros.
[[nodiscard]] Polynomial trimmed(Polynomial p);
[[nodiscard]] Polynomial sum(const Polynomial& p, const Polynomial& q);
[[nodiscard]] Polynomial difference(const Polynomial& p, const Polynomial& q);
[[nodiscard]] Polynomial product(const Polynomial& p, const Polynomial& q);
[[nodiscard]] Polynomial scaled(const Polynomial& p, const Rational& factor);
[[nodiscard]] Polynomial derivative(const Polynomial& p);
/// p divided by its leading coefficient. Precondition: p is not 0.
[[nodiscard]] Polynomial monic(const Polynomial& p);
[[nodiscard]] Rational value(const Polynomial& p, const Rational& x);
/// Quotient and remainder. Precondition: q is not 0.
[[nodiscard]] std::pair<Polynomial, Polynomial> divided(const Polynomial& p, const Polynomial& q);
/// Monic greatest common divisor by Euclid's algorithm; {} when both are 0.
[[nodiscard]] Polynomial common_divisor(Polynomial p, Polynomial q);

/// p = leading coefficient · Π factor^multiplicity, factors monic, without multiple roots, pairwise without common
/// ones, of degree at least 1 (Yun 1976). Precondition: p is not 0.
struct SquareFreeFactor {
  Polynomial factor;
  int multiplicity = 1;
};
[[nodiscard]] std::vector<SquareFreeFactor> square_free_factors(const Polynomial& p);

/// The polynomial of degree < nodes with these values. Precondition: nodes differ, as many as values.
[[nodiscard]] Polynomial interpolated(const std::vector<Rational>& nodes, const std::vector<Rational>& values);

/// det(X − M) of a square matrix, rows one after the other; monic. Faddeev–LeVerrier over the integers: O(n⁴).
[[nodiscard]] Polynomial characteristic_polynomial(const std::vector<Rational>& matrix, std::size_t n);

}  // namespace hexact
