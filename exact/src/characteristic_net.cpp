// SPDX-License-Identifier: LGPL-3.0-or-later
#include "characteristic_net.hpp"

#include "hexact/kernel/errors.hpp"
#include "mode_matrix.hpp"

#include <algorithm>
#include <cstdlib>

namespace hexact {
namespace {

using Rows = std::vector<std::vector<ComplexInterval>>;

/// e^{2πi a/k} for any a.
ComplexInterval turn(int a, int k) {
  int d = ((a % k) + k) % k;
  if (2 * d > k) d -= k;
  return {Interval::cosine(d, k), Interval::sine(d, k)};
}

double size(const ComplexInterval& x) { return norm(x).middle().lower_double(); }

bool excludes_zero(const ComplexInterval& x) { return norm(x).sign() > 0; }

/// M − λ, with the column of the first vertex at the end, negated: the right-hand side for u(first) = 1.
Rows eigenvector_equations(const ModeMatrix& m, int k, const RationalInterval& eigenvalue) {
  Rows rows(m.n, std::vector<ComplexInterval>(m.n));
  for (std::size_t r = 0; r < m.n; ++r) {
    for (std::size_t c = 0; c < m.n; ++c) {
      ComplexInterval x;
      for (const auto& [exponent, w] : m.at(r, c)) x = x + turn(exponent, k) * Interval(w);
      if (r == c) x.re = x.re - Interval(eigenvalue.lo, eigenvalue.hi);
      rows[r][c == 0 ? m.n - 1 : c - 1] = c == 0 ? ComplexInterval{-x.re, -x.im} : x;
    }
  }
  return rows;
}

/// Elimination over all rows, one more than unknowns; the row that is left over is not used.
std::optional<std::vector<ComplexInterval>> solved(Rows rows) {
  const std::size_t unknowns = rows.size() - 1;
  for (std::size_t c = 0; c < unknowns; ++c) {
    const auto pivot = std::max_element(rows.begin() + static_cast<std::ptrdiff_t>(c), rows.end(),
                                        [c](const auto& a, const auto& b) { return size(a[c]) < size(b[c]); });
    std::swap(rows[c], *pivot);
    if (!excludes_zero(rows[c][c])) return std::nullopt;
    for (std::size_t r = c + 1; r < rows.size(); ++r) {
      if (size(rows[r][c]) == 0 && !excludes_zero(rows[r][c]) && norm(rows[r][c]).upper_double() == 0) continue;
      const ComplexInterval factor = rows[r][c] / rows[c][c];
      for (std::size_t i = c + 1; i <= unknowns; ++i) rows[r][i] = rows[r][i] - factor * rows[c][i];
      rows[r][c] = {};
    }
  }
  std::vector<ComplexInterval> x(unknowns);
  for (std::size_t c = unknowns; c-- > 0;) {
    ComplexInterval v = rows[c][unknowns];
    for (std::size_t i = c + 1; i < unknowns; ++i) v = v - rows[c][i] * x[i];
    x[c] = v / rows[c][c];
  }
  return x;
}

}  // namespace

CharacteristicNet::CharacteristicNet(SectorLattice lattice, int valence, std::vector<std::array<int, 2>> vertices,
                                     std::vector<ComplexInterval> points)
    : lattice_(lattice), valence_(valence), side_(1), points_(std::move(points)) {
  for (const auto& [i, j] : vertices) side_ = std::max({side_, i + 1, j + 1});
  number_.assign(static_cast<std::size_t>(side_ * side_), points_.size());
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    number_[static_cast<std::size_t>(vertices[v][0] * side_ + vertices[v][1])] = v;
  }
  for (int s = -1; s <= 2; ++s) turns_.push_back(turn(s, valence));
}

ComplexInterval CharacteristicNet::at(int i, int j) const {
  const Place p = place(lattice_, i, j);
  if (lattice_ != SectorLattice::dual && p.i == 0 && p.j == 0) return {};
  HEXACT_EXPECTS(p.i >= 0 && p.j >= 0 && p.i < side_ && p.j < side_);
  const std::size_t v = number_[static_cast<std::size_t>(p.i * side_ + p.j)];
  HEXACT_EXPECTS(v < points_.size());
  return p.shift == 0 ? points_[v] : points_[v] * turns_[static_cast<std::size_t>(p.shift + 1)];
}

std::optional<CharacteristicNet> characteristic_net(const SubdivisionMatrix& matrix, const RationalInterval& eigenvalue) {
  const ModeMatrix m = mode_matrix(matrix, 1);
  auto solution = solved(eigenvector_equations(m, matrix.valence, eigenvalue));
  if (!solution) return std::nullopt;
  std::vector<ComplexInterval> points{{Interval(1), Interval(0)}};
  points.insert(points.end(), solution->begin(), solution->end());
  if (matrix.lattice != SectorLattice::dual) {  // the first vertex is on the side of the sector: half a sector back
    const Interval c = Interval::cosine(1, matrix.valence);
    const ComplexInterval back = {sqrt((Interval(1) + c) / Interval(2)), -sqrt((Interval(1) - c) / Interval(2))};
    for (ComplexInterval& p : points) p = p * back;
  }
  return CharacteristicNet(matrix.lattice, matrix.valence, matrix.vertices, std::move(points));
}

}  // namespace hexact
