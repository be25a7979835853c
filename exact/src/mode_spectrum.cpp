// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/eigenvalues.hpp"
#include "hexact/kernel/errors.hpp"
#include "interval.hpp"
#include "polynomial.hpp"
#include "root_disc.hpp"

#include <algorithm>
#include <complex>
#include <optional>

namespace hexact {
namespace {

constexpr long kWidthBits = 104;

using Coefficients = std::vector<Interval>;

Interval value(const Coefficients& p, const Interval& x) {
  Interval v(0);
  for (std::size_t i = p.size(); i-- > 0;) v = v * x + p[i];
  return v;
}

Coefficients enclosed(const Polynomial& p) {
  Coefficients out;
  for (const Rational& x : p) out.push_back(Interval(x));
  return out;
}

using Complex = std::complex<long double>;

/// Approximations of all roots of a monic polynomial (Aberth 1973). They are candidates and prove nothing.
std::vector<Complex> approximate_roots(const Coefficients& p) {
  const std::size_t n = p.size() - 1;
  std::vector<long double> a;
  for (const Interval& x : p) a.push_back(static_cast<long double>(x.middle().lower_double()));
  long double radius = 0;
  for (std::size_t i = 0; i < n; ++i) {
    if (a[i] != 0) radius = std::max(radius, 2 * std::pow(std::fabs(a[i]), 1.0L / static_cast<long double>(n - i)));
  }
  std::vector<Complex> z;
  for (std::size_t i = 0; i < n; ++i) {
    z.push_back(std::polar(radius * (static_cast<long double>(i) + 1) / static_cast<long double>(n), 2.3L * static_cast<long double>(i) + 0.4L));
  }
  for (int round = 0; round < 200; ++round) {
    long double change = 0;
    for (std::size_t i = 0; i < n; ++i) {
      Complex v = 0, slope = 0;
      for (std::size_t j = n + 1; j-- > 0;) slope = slope * z[i] + v, v = v * z[i] + a[j];
      if (v == Complex(0)) continue;
      Complex repulsion = 0;
      for (std::size_t j = 0; j < n; ++j) {
        if (j != i && z[i] != z[j]) repulsion += 1.0L / (z[i] - z[j]);
      }
      const Complex step = 1.0L / (slope / v - repulsion);
      if (!std::isfinite(step.real()) || !std::isfinite(step.imag())) continue;
      z[i] -= step;
      change = std::max(change, std::abs(step));
    }
    if (change < 1e-19L * radius) break;
  }
  return z;
}

/// Newton's method from an approximation of a simple real root; a point very near the root, if all goes well.
Rational refined(const Coefficients& p, long double start) {
  Interval x(Rational::from_double(static_cast<double>(start)));
  for (int i = 0; i < 7; ++i) {
    Interval v(0), slope(0);
    for (std::size_t j = p.size(); j-- > 0;) slope = slope * x + v, v = v * x + p[j];
    if (slope.sign() == 0) break;
    x = (x - v / slope).middle();
  }
  return x.lower();
}

Rational floor_to_grid(const Rational& x, long bits) {
  const Rational s = x.scaled(bits);
  return Rational(floor_quotient(s.numerator(), s.denominator())).scaled(-bits);
}

/// An interval of width 2^-kWidthBits around x at whose ends p has different signs, for certain.
std::optional<RationalInterval> sign_change(const Coefficients& p, const Rational& x) {
  const Rational width = Rational(1).scaled(-kWidthBits), half = Rational(1).scaled(-kWidthBits - 1);
  const Rational lo = floor_to_grid(x, kWidthBits);
  for (const Rational& shift : {Rational(0), half, -half}) {
    const RationalInterval r{lo + shift, lo + shift + width};
    if (value(p, Interval(r.lo)).sign() * value(p, Interval(r.hi)).sign() < 0) return r;
  }
  return std::nullopt;
}

/// The fraction of least denominator near x, if its denominator is small.
std::optional<Rational> simple_fraction(const Rational& x) {
  const Rational near = Rational(1).scaled(-150);
  Integer p0(0), q0(1), p1(1), q1(0);
  Rational rest = x;
  while (q1.bit_length() <= 64) {
    const Integer a = floor_quotient(rest.numerator(), rest.denominator());
    Integer p2 = a * p1 + p0, q2 = a * q1 + q0;
    p0 = std::move(p1), q0 = std::move(q1), p1 = std::move(p2), q1 = std::move(q2);
    const Rational candidate(p1, q1);
    if (abs(candidate - x) < near) return candidate;
    rest = Rational(1) / (rest - Rational(a));
  }
  return std::nullopt;
}

class ModeSolver {
 public:
  ModeSolver(int mode, int k) : mode_(mode), k_(k) {}

  void add(const CharacteristicFactor& factor) {
    const RationalCosine c = rational_cosine(factor.angle, k_);
    std::size_t longest = 0;
    for (const CosinePolynomial& p : factor.coefficients) longest = std::max(longest, p.size());
    if (c.found || longest <= 1) {
      Polynomial p;
      for (const CosinePolynomial& a : factor.coefficients) p.push_back(hexact::value(a, c.value));
      for (const SquareFreeFactor& f : square_free_factors(p)) add_square_free(f.factor, f.multiplicity);
    } else {
      const Interval cosine = Interval::cosine(factor.angle, k_);
      Coefficients p;
      for (const CosinePolynomial& a : factor.coefficients) p.push_back(value(enclosed(a), cosine));
      add_simple(p, 1);
    }
  }

  [[nodiscard]] ModeSpectrum result() && {
    std::sort(out_.isolated.begin(), out_.isolated.end(),
              [](const Eigenvalue& a, const Eigenvalue& b) { return a.enclosure.lo > b.enclosure.lo; });
    merge_equal();
    return std::move(out_);
  }

 private:
  void add_square_free(Polynomial p, int multiplicity) {
    for (const Complex& z : approximate_roots(enclosed(p))) {
      if (p.size() <= 1) break;
      if (std::fabs(z.imag()) > 1e-9L) continue;
      const auto r = simple_fraction(refined(enclosed(p), z.real()));
      if (!r || !hexact::value(p, *r).is_zero()) continue;
      out_.isolated.push_back({mode_, {*r, *r}, multiplicity});
      p = divided(p, {-*r, Rational(1)}).first;
    }
    if (p.size() > 1) add_simple(enclosed(p), multiplicity);
  }

  /// A polynomial without multiple roots, as far as is known: counts the changes of sign that it proves.
  void add_simple(const Coefficients& p, int multiplicity) {
    std::vector<RationalInterval> found;
    std::vector<Complex> left;
    for (const Complex& z : approximate_roots(p)) {
      std::optional<RationalInterval> r;
      if (std::fabs(z.imag()) <= 1e-9L) r = sign_change(p, refined(p, z.real()));
      const auto overlaps = [&](const RationalInterval& other) { return r->lo <= other.hi && other.lo <= r->hi; };
      if (r && std::none_of(found.begin(), found.end(), overlaps)) found.push_back(*r);
      else left.push_back(z);
    }
    for (const RationalInterval& r : found) out_.isolated.push_back({mode_, r, multiplicity});
    if (left.empty()) return;
    out_.remaining += static_cast<int>(left.size()) * multiplicity;
    out_.remaining_bound = std::max(out_.remaining_bound, remaining_root_bound(p, found));
  }

  /// The same rational number may come from several factors.
  void merge_equal() {
    std::vector<Eigenvalue> merged;
    for (Eigenvalue& e : out_.isolated) {
      if (!merged.empty() && e.enclosure.lo == e.enclosure.hi && merged.back().enclosure == e.enclosure) {
        merged.back().multiplicity += e.multiplicity;
      } else {
        merged.push_back(std::move(e));
      }
    }
    out_.isolated = std::move(merged);
  }

  int mode_, k_;
  ModeSpectrum out_;
};

}  // namespace

namespace {

ModeSpectrum solved(const std::vector<CharacteristicFactor>& factors, int mode, int k) {
  ModeSolver solver(mode, k);
  for (const CharacteristicFactor& factor : factors) solver.add(factor);
  return std::move(solver).result();
}

}  // namespace

ModeSpectrum mode_spectrum(const SubdivisionMatrix& matrix, int mode) { return solved(characteristic_factors(matrix, mode), mode, matrix.valence); }

std::vector<ModeSpectrum> mode_spectra(const SubdivisionMatrix& matrix) {
  std::vector<ModeSpectrum> out;
  for (const auto& factors : characteristic_factors(matrix)) out.push_back(solved(factors, static_cast<int>(out.size()), matrix.valence));
  return out;
}

}  // namespace hexact
