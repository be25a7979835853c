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

[[noreturn]] void fail_not_symmetric() {
  throw InvalidInput("NotSymmetric", "the weights have no mirror image: a characteristic polynomial is not real", "mode matrix");
}

/// A Laurent polynomial that is its own mirror image, in c: w_0 + Σ 2 w_e T_e(c), with Chebyshev's T_{e+1} = 2c T_e − T_{e−1}.
CosinePolynomial in_cosine(const Laurent& x) {
  const auto weight = [&](int exponent) {
    const auto found = x.find(exponent);
    return found == x.end() ? Rational() : found->second;
  };
  int last = 0;
  for (const auto& [exponent, w] : x) {
    if (weight(-exponent) != w) fail_not_symmetric();
    last = std::max(last, exponent);
  }
  CosinePolynomial out(static_cast<std::size_t>(last) + 1);
  out[0] = weight(0);
  Polynomial before, now{Rational(1)};
  for (int e = 1; e <= last; ++e) {
    Polynomial next = product(now, {Rational(0), Rational(e == 1 ? 1 : 2)});
    for (std::size_t i = 0; i < before.size(); ++i) next[i] -= before[i];
    before = std::move(now);
    now = std::move(next);
    const Rational twice = Rational(2) * weight(e);
    for (std::size_t i = 0; i < now.size() && !twice.is_zero(); ++i) out[i] += twice * now[i];
  }
  return trimmed(std::move(out));
}

/// L − x.
std::vector<CosinePolynomial> linear_factor(const Laurent& x) {
  CosinePolynomial constant = in_cosine(x);
  for (Rational& a : constant) a = -a;
  return {std::move(constant), {Rational(1)}};
}

/// The length of the weights of a set over one denominator; what is longer than 2^20 bits is not looked at in full.
std::size_t bits_of(const ModeMatrix& m, const std::vector<std::size_t>& set) {
  constexpr std::size_t kEnough = std::size_t{1} << 20;
  Integer denominator(1);
  std::size_t longest = 0;
  for (const std::size_t r : set) {
    for (const std::size_t c : set) {
      for (const auto& [exponent, w] : m.at(r, c)) {
        if (denominator.bit_length() + w.denominator().bit_length() > kEnough) return kEnough;
        denominator = lcm(denominator, w.denominator());
        longest = std::max(longest, w.numerator().bit_length());
      }
    }
  }
  return denominator.bit_length() + longest;
}

/// About the number of products of words that the polynomial of a set costs: n⁴ of integers at each of nw + 1 nodes, and
/// divided differences of fractions.
double work_of(const ModeMatrix& m, const std::vector<std::size_t>& set) {
  const auto n = static_cast<double>(set.size());
  const int widest = largest_exponent(m, set), degree = static_cast<int>(set.size()) * widest;
  const auto bits = static_cast<double>(bits_of(m, set) + 2 * static_cast<std::size_t>(widest) * Integer(degree + 1).bit_length());
  return (n * n * n * n * (degree + 1.0) + 8 * (n + 1) * degree * degree) * (n * bits / 64 + 1);
}

/// The same in hexact-check, so that both programs refuse the same matrices: minutes of work for a small file.
void expect_feasible(const ModeMatrix& m, const std::vector<std::size_t>& set) {
  constexpr double kMost = 1 << 30;
  if (work_of(m, set) <= kMost) return;
  throw ResourceLimit("the characteristic polynomial of " + std::to_string(set.size()) + " rows that depend on each other over " +
                      std::to_string(largest_exponent(m, set)) + " sectors is beyond the bound of work");
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
    if (degree > 0 && p != at_rational(m, set, inverse)) fail_not_symmetric();
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
  const auto sets = dependent_sets(m);
  for (const auto& set : sets) expect_feasible(m, set);
  std::vector<CharacteristicFactor> out;
  for (const auto& set : sets) {
    add_split(out, m.angle, set.size() == 1 ? linear_factor(m.at(set[0], set[0])) : interpolated_factor(m, set));
  }
  return out;
}

std::vector<std::vector<CharacteristicFactor>> characteristic_factors(const SubdivisionMatrix& matrix) {
  std::vector<std::vector<CharacteristicFactor>> out{characteristic_factors(matrix, 0)};
  for (int mode = 1; 2 * mode <= matrix.valence; ++mode) {
    const bool is_new = mode == 1 || (mode == 2 && !matrix.harmonic.empty());
    out.push_back(is_new ? characteristic_factors(matrix, mode) : out.back());
    for (CharacteristicFactor& f : out.back()) f.angle = mode;
  }
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
