// SPDX-License-Identifier: LGPL-3.0-or-later
#include "midedge_operator.hpp"

#include "hexact/exact/midedge_limit.hpp"

#include <cmath>
#include <complex>
#include <numbers>
#include <optional>

namespace hexact::detail {
namespace {

/// atan(1/n) between two partial sums of its alternating series.
FixedInterval inverse_tangent(int n) {
  Rational sum, power = Rational(1) / Rational(n);
  const Rational step = power * power;
  const Rational least = Rational(1).scaled(-static_cast<long>(FixedInterval::kBits) - 8);
  for (int j = 0;; ++j) {
    const Rational term = power / Rational(2 * j + 1), after = j % 2 == 0 ? sum + term : sum - term;
    if (term < least) {
      const FixedInterval a(std::min(sum, after)), b(std::max(sum, after));
      return {a.low, b.high};
    }
    sum = after;
    power *= step;
  }
}

const FixedInterval& pi() {  // Machin
  static const FixedInterval value = FixedInterval(16) * inverse_tangent(5) - FixedInterval(4) * inverse_tangent(239);
  return value;
}

/// Σ ± x^n/n! over even or odd n. By Taylor the rest is at most |x|^n/n! of the first term left out.
FixedInterval taylor(const FixedInterval& x, int first) {
  FixedInterval term = first == 0 ? FixedInterval(1) : x, sum(0);
  const FixedInterval square = x * x;
  for (int n = first;; n += 2) {
    if (Rational(std::max(abs(Rational(term.low)), abs(Rational(term.high)))) < Rational(2)) {
      return sum + FixedInterval(Integer(-2), Integer(2));
    }
    sum = sum + term;
    term = -(term * square) / FixedInterval((n + 1) * (n + 2));
  }
}

template <class T>
NetMatrix<T> mode_matrix(const std::vector<std::array<std::array<Rational, kNet>, kNet>>& blocks, const std::vector<Complex<T>>& powers) {
  NetMatrix<T> b;
  for (std::size_t r = 0; r < kNet; ++r) {
    for (std::size_t c = 0; c < kNet; ++c) {
      b[r][c] = {T(0), T(0)};
      for (std::size_t d = 0; d < blocks.size(); ++d) {
        if (blocks[d][r][c].is_zero()) continue;
        const T weight(blocks[d][r][c]);
        b[r][c] = b[r][c] + Complex<T>{weight * powers[d].re, weight * powers[d].im};
      }
    }
  }
  return b;
}

bool certainly_nonzero(const Complex<Rational>& x) { return !x.re.is_zero() || !x.im.is_zero(); }
bool certainly_nonzero(const Complex<FixedInterval>& x) { return x.re.certain_sign() != 0 || x.im.certain_sign() != 0; }
double size_of(const Complex<Rational>& x) { return std::hypot(x.re.to_double(), x.im.to_double()); }
double size_of(const Complex<FixedInterval>& x) { return std::hypot(x.re.middle().to_double(), x.im.middle().to_double()); }

/// Brings rows (n of them, of n or more columns) to upper triangular form; returns the determinant of the first n columns,
/// or nothing where no pivot is certain.
template <class T>
std::optional<Complex<T>> eliminate(std::vector<std::vector<Complex<T>>>& a) {
  const std::size_t n = a.size();
  Complex<T> determinant{T(1), T(0)};
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t pivot = i;
    for (std::size_t r = i + 1; r < n; ++r) {
      if (size_of(a[r][i]) > size_of(a[pivot][i])) pivot = r;
    }
    if (pivot != i) {
      std::swap(a[i], a[pivot]);
      determinant = Complex<T>{T(0), T(0)} - determinant;
    }
    determinant = determinant * a[i][i];
    if (i + 1 == n) break;
    if (!certainly_nonzero(a[i][i])) return std::nullopt;
    for (std::size_t r = i + 1; r < n; ++r) {
      const Complex<T> factor = a[r][i] / a[i][i];
      for (std::size_t c = i; c < a[r].size(); ++c) a[r][c] = a[r][c] - factor * a[i][c];
    }
  }
  return determinant;
}

/// l with l_0 = 1 and l (B − λ) = 0, by the equations of columns 1 to 8.
template <class T>
NetVector<T> left_null_vector(const NetMatrix<T>& b, const T& lambda) {
  std::vector<std::vector<Complex<T>>> a(kNet - 1);
  for (std::size_t c = 1; c < kNet; ++c) {
    for (std::size_t r = 1; r < kNet; ++r) a[c - 1].push_back(r == c ? b[r][c] - Complex<T>{lambda, T(0)} : b[r][c]);
    a[c - 1].push_back(Complex<T>{T(0), T(0)} - b[0][c]);
  }
  const std::size_t n = a.size();
  if (!eliminate(a) || !certainly_nonzero(a[n - 1][n - 1])) throw NumericalFailure("the left eigenvector could not be enclosed");
  NetVector<T> l;
  l[0] = {T(1), T(0)};
  for (std::size_t i = n; i-- > 0;) {
    Complex<T> rest = a[i][n];
    for (std::size_t c = i + 1; c < n; ++c) rest = rest - a[i][c] * l[c + 1];
    l[i + 1] = rest / a[i][i];
  }
  return l;
}

/// The dominant eigenvalue in floating point, to be proved afterwards.
double power_iteration(const NetMatrix<FixedInterval>& b) {
  std::array<std::array<std::complex<double>, kNet>, kNet> m;
  for (std::size_t r = 0; r < kNet; ++r) {
    for (std::size_t c = 0; c < kNet; ++c) m[r][c] = {b[r][c].re.middle().to_double(), b[r][c].im.middle().to_double()};
  }
  std::array<std::complex<double>, kNet> x;
  x.fill({1, 0.1});
  double lambda = 0;
  for (int step = 0; step < 400; ++step) {
    std::array<std::complex<double>, kNet> y{};
    double before = 0, after = 0;
    for (std::size_t r = 0; r < kNet; ++r) {
      for (std::size_t c = 0; c < kNet; ++c) y[r] += m[r][c] * x[c];
      before += std::norm(x[r]);
      after += std::norm(y[r]);
    }
    lambda = std::sqrt(after / before);
    for (std::size_t r = 0; r < kNet; ++r) x[r] = y[r] / std::sqrt(after);
  }
  return lambda;
}

/// Sign of det(B − λ), which is real because reflection makes B similar to a real matrix; 0 if uncertain.
int determinant_sign(const NetMatrix<FixedInterval>& b, const Rational& lambda) {
  std::vector<std::vector<Complex<FixedInterval>>> a(kNet);
  for (std::size_t r = 0; r < kNet; ++r) {
    a[r].assign(b[r].begin(), b[r].end());
    a[r][r].re = a[r][r].re - FixedInterval(lambda);
  }
  const auto determinant = eliminate(a);
  return determinant ? determinant->re.certain_sign() : 0;
}

/// An interval around `near` at whose ends the determinant has opposite signs, made narrow by halving.
FixedInterval enclosed_eigenvalue(const NetMatrix<FixedInterval>& b, double near) {
  Rational low = Rational::from_double(near) - Rational(1).scaled(-30), high = low + Rational(1).scaled(-29);
  const int sign_low = determinant_sign(b, low), sign_high = determinant_sign(b, high);
  if (sign_low * sign_high != -1) throw NumericalFailure("the subdominant eigenvalue could not be enclosed");
  for (int step = 0; step < 180; ++step) {
    const Rational middle = (low + high).scaled(-1);
    const int sign = determinant_sign(b, middle);
    if (sign == 0) break;
    (sign == sign_low ? low : high) = middle;
  }
  return {FixedInterval(low).low, FixedInterval(high).high};
}

}  // namespace

Complex<FixedInterval> root_of_unity(std::uint32_t m, std::uint32_t k) {
  const FixedInterval angle = FixedInterval(static_cast<int>(2 * m)) * pi() / FixedInterval(static_cast<int>(k));
  return {taylor(angle, 0), taylor(angle, 1)};
}

MidedgeMap midedge_patch(const MidedgeBoundaryPattern& pattern) {
  const auto k = static_cast<std::uint32_t>(pattern.size());
  std::vector<std::uint32_t> number(9 * pattern.size(), kNoTwin);
  std::uint32_t count = 0;
  const auto vertex = [&](std::uint32_t s, std::uint32_t i, std::uint32_t j) {
    std::uint32_t& v = number[9 * (s % k) + 3 * i + j];
    if (v == kNoTwin) v = count++;
    return make_id<VertexId>(v);
  };
  FacetLoops loops;
  for (std::uint32_t s = 0; s < k; ++s) loops.add_corner(vertex(s, 0, 0));
  loops.close_loop();
  for (std::uint32_t s = 0; s < k; ++s) {
    const std::uint32_t p = s + k - 1;
    for (std::uint32_t i = 0; i < 2; ++i) {
      if (pattern[p % k] != MidedgeCorner::rim) {
        loops.add(std::array{vertex(s, i, 0), vertex(p, 0, i), vertex(p, 0, i + 1), vertex(s, i + 1, 0)});
      }
      for (std::uint32_t j = 0; j < 2 && pattern[s] == MidedgeCorner::inner; ++j) {
        loops.add(std::array{vertex(s, i, j), vertex(s, i + 1, j), vertex(s, i + 1, j + 1), vertex(s, i, j + 1)});
      }
    }
  }
  return MidedgeMap(loops, count);
}

std::vector<std::array<std::array<Rational, kNet>, kNet>> two_step_blocks(std::uint32_t k) {
  const MidedgeMap coarse = midedge_patch(MidedgeBoundaryPattern(k, MidedgeCorner::inner));
  const MidedgeMap fine = coarse.double_stepped();
  const std::vector<std::uint32_t> from = midedge_net(coarse, 0), to = midedge_net(fine, 0);
  HEXACT_INVARIANT(from.size() == kNet * k && to.size() == kNet * k);
  std::vector<std::array<std::array<Rational, kNet>, kNet>> blocks(k);
  for (std::size_t c = 0; c < kNet; ++c) {
    PointArray<Rational> unit(coarse.vertex_count());
    unit[from[c]].x = Rational(1);  // in sector 0: fine sector −d then shows block d
    const PointArray<Rational> result = corner_points<Rational>(coarse, unit, MidedgeRule::six_point);
    for (std::size_t d = 0; d < k; ++d) {
      for (std::size_t r = 0; r < kNet; ++r) blocks[d][r][c] = result[to[kNet * ((k - d) % k) + r]].x;
    }
  }
  return blocks;
}

LeftEigenvector<FixedInterval> enclosed_left_eigenvector(std::uint32_t k) {
  std::vector<Complex<FixedInterval>> powers;
  for (std::uint32_t d = 0; d < k; ++d) powers.push_back(root_of_unity(d, k));
  const NetMatrix<FixedInterval> b = mode_matrix(two_step_blocks(k), powers);
  const FixedInterval lambda = enclosed_eigenvalue(b, power_iteration(b));
  return {lambda, left_null_vector(b, lambda)};
}

LeftEigenvector<Rational> exact_left_eigenvector() {
  const std::vector<Complex<Rational>> powers{{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  const NetMatrix<Rational> b = mode_matrix(two_step_blocks(4), powers);
  const Rational half = Rational(1) / Rational(2);
  return {half, left_null_vector(b, half)};
}

}  // namespace hexact::detail
