// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/rational.hpp"

#include <array>
#include <map>
#include <optional>

namespace hexact {

/// A Laurent polynomial in z and w with rational coefficients; z^a w^b stands for the vector (a, b). Coefficients that
/// are 0 are not stored, so equality is equality of polynomials.
class Symbol {
 public:
  using Vector = std::array<int, 2>;

  Symbol() = default;
  Symbol(const Rational& constant) { add({0, 0}, constant); }  // NOLINT(google-explicit-constructor): constants are symbols
  /// z^a w^b for v = (a, b).
  [[nodiscard]] static Symbol monomial(const Vector& v, const Rational& weight = Rational(1));

  void add(const Vector& v, const Rational& weight);
  [[nodiscard]] Rational coefficient(const Vector& v) const;
  [[nodiscard]] const std::map<Vector, Rational>& terms() const noexcept { return terms_; }
  [[nodiscard]] bool has_negative_coefficient() const;
  /// The value at z = w = 1.
  [[nodiscard]] Rational total() const;

  /// With every vector (a, b) replaced by a · first + b · second.
  [[nodiscard]] Symbol mapped(const Vector& first, const Vector& second) const;
  /// Times z^a w^b.
  [[nodiscard]] Symbol shifted(const Vector& v) const;
  /// Divided by 1 + z^a w^b, where (a, b) = direction; none if that leaves a rest. Precondition: direction is not 0.
  [[nodiscard]] std::optional<Symbol> without(const Vector& direction) const;

  friend Symbol operator+(const Symbol& p, const Symbol& q);
  friend Symbol operator*(const Symbol& p, const Symbol& q);
  friend bool operator==(const Symbol&, const Symbol&) = default;

 private:
  std::map<Vector, Rational> terms_;
};

/// Order of the zero at z = s, w = t, each of them 1 or −1: all derivatives of smaller order vanish there.
/// Precondition: p is not 0.
[[nodiscard]] int zero_order(const Symbol& p, int s, int t);

}  // namespace hexact
