// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/eigenvalues.hpp"
#include "hexact/kernel/errors.hpp"
#include "mode_matrix.hpp"
#include "polynomial.hpp"

#include <algorithm>
#include <numeric>

namespace hexact {
namespace {

Rational power(const Rational& z, int exponent) {
  Rational r(1);
  for (int i = 0; i < std::abs(exponent); ++i) r *= z;
  return exponent < 0 ? Rational(1) / r : r;
}

/// det(L − M(z)) of the diagonal block on a set of rows at a rational z.
Polynomial at_rational(const ModeMatrix& m, const std::vector<std::size_t>& set, const Rational& z) {
  std::vector<Rational> a;
  for (const std::size_t r : set) {
    for (const std::size_t c : set) {
      Rational x;
      for (const auto& [exponent, w] : m.at(r, c)) x += w * power(z, exponent);
      a.push_back(std::move(x));
    }
  }
  return characteristic_polynomial(a, set.size());
}

int largest_exponent(const ModeMatrix& m, const std::vector<std::size_t>& set) {
  int d = 0;
  for (const std::size_t r : set) {
    for (const std::size_t c : set) {
      for (const auto& [exponent, w] : m.at(r, c)) d = std::max(d, std::abs(exponent));
    }
  }
  return d;
}

/// Coefficients as polynomials in c = (z + 1/z)/2 by interpolation at z = 2, 3, …
std::vector<CosinePolynomial> interpolated_factor(const ModeMatrix& m, const std::vector<std::size_t>& set) {
  const int degree = static_cast<int>(set.size()) * largest_exponent(m, set);
  std::vector<Rational> nodes;
  std::vector<std::vector<Rational>> values(set.size() + 1);
  for (int i = 0; i <= degree; ++i) {
    const Rational z(i + 2), inverse = Rational(1) / z;
    nodes.push_back((z + inverse) / Rational(2));
    const Polynomial p = at_rational(m, set, z);
    // Two Laurent polynomials that agree with their mirror images at so many nodes are mirror images of themselves.
    if (degree > 0 && p != at_rational(m, set, inverse)) {
      throw InvalidInput("NotSymmetric", "the weights have no mirror image: a characteristic polynomial is not real", "mode matrix");
    }
    for (std::size_t j = 0; j <= set.size(); ++j) values[j].push_back(p[j]);
  }
  std::vector<CosinePolynomial> out;
  for (const auto& v : values) out.push_back(interpolated(nodes, v));
  return out;
}

/// The coefficient of c^power as a polynomial in L.
Polynomial in_eigenvalue(const std::vector<CosinePolynomial>& factor, std::size_t power_of_c) {
  Polynomial p(factor.size());
  for (std::size_t i = 0; i < factor.size(); ++i) {
    if (power_of_c < factor[i].size()) p[i] = factor[i][power_of_c];
  }
  return trimmed(std::move(p));
}

std::vector<CosinePolynomial> constant_in_c(const Polynomial& p) {
  std::vector<CosinePolynomial> out;
  for (const Rational& x : p) out.push_back(trimmed({x}));
  return out;
}

/// Splits off the greatest factor that does not depend on c.
void add_split(std::vector<CharacteristicFactor>& out, int angle, const std::vector<CosinePolynomial>& factor) {
  std::size_t length = 0;
  for (const CosinePolynomial& p : factor) length = std::max(length, p.size());
  Polynomial constant;
  std::vector<Polynomial> parts;
  for (std::size_t j = 0; j < length; ++j) {
    parts.push_back(in_eigenvalue(factor, j));
    constant = common_divisor(constant, parts.back());
  }
  if (constant.size() > 1) out.push_back({angle, constant_in_c(constant)});
  if (constant.size() == factor.size()) return;
  std::vector<CosinePolynomial> rest(factor.size() - constant.size() + 1);
  for (std::size_t j = 0; j < length; ++j) {
    const Polynomial quotient = divided(parts[j], constant).first;
    for (std::size_t i = 0; i < quotient.size(); ++i) {
      rest[i].resize(std::max(rest[i].size(), j + 1));
      rest[i][j] = quotient[i];
    }
  }
  for (CosinePolynomial& p : rest) p = trimmed(std::move(p));
  out.push_back({angle, std::move(rest)});
}

}  // namespace

std::vector<CharacteristicFactor> characteristic_factors(const SubdivisionMatrix& matrix, int mode) {
  const ModeMatrix m = mode_matrix(matrix, mode);
  std::vector<CharacteristicFactor> out;
  for (const auto& set : dependent_sets(m)) add_split(out, m.angle, interpolated_factor(m, set));
  return out;
}

RationalCosine rational_cosine(int angle, int k) {
  const int g = std::gcd(angle, k);
  switch (k / g) {
    case 1: return {true, Rational(1)};
    case 2: return {true, Rational(-1)};
    case 3: return {true, Rational(-1) / Rational(2)};
    case 4: return {true, Rational(0)};
    case 6: return {true, Rational(1) / Rational(2)};
    default: return {};
  }
}

}  // namespace hexact
