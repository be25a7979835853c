// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mode_matrix.hpp"

#include "hexact/kernel/errors.hpp"
#include "polynomial.hpp"

namespace hexact {
namespace {

void add(Laurent& to, int exponent, const Rational& w) {
  if (w.is_zero()) return;
  Rational& x = to[exponent];
  x += w;
  if (x.is_zero()) to.erase(exponent);
}

/// The shift in (−k/2, k/2); a half turn is taken half in each direction, so that mirror images stay such.
void add_shift(Laurent& to, int shift, int k, const Rational& w) {
  int d = ((shift % k) + k) % k;
  if (2 * d == k) {
    add(to, d, w / Rational(2));
    add(to, -d, w / Rational(2));
  } else {
    if (2 * d > k) d -= k;
    add(to, d, w);
  }
}

/// A polynomial in c = (z + 1/z)/2.
Laurent in_z(const CosinePolynomial& p) {
  Laurent out;
  Polynomial previous{Rational(1)};  // (1 + z²)^i, z^{-i} taken out
  Rational scale(1);
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j < previous.size(); ++j) {
      add(out, static_cast<int>(j) - static_cast<int>(i), p[i] * previous[j] * scale);
    }
    previous = product(previous, {Rational(1), Rational(0), Rational(1)});
    scale /= Rational(2);
  }
  return out;
}

}  // namespace

ModeMatrix mode_matrix(const SubdivisionMatrix& matrix, int mode) {
  const int k = matrix.valence;
  HEXACT_EXPECTS(mode >= 0 && 2 * mode <= k);
  const bool centre = mode == 0 && matrix.has_centre;
  ModeMatrix m;
  m.n = matrix.size() + (centre ? 1 : 0);
  m.angle = mode == 0 ? 1 : mode;
  m.entries.resize(m.n * m.n);
  const auto entry = [&](std::size_t r, std::size_t c) -> Laurent& { return m.entries[r * m.n + c]; };
  for (const SectorWeight& w : matrix.local) {
    if (mode == 0) add(entry(w.row, w.column), 0, w.weight);
    else add_shift(entry(w.row, w.column), w.shift, k, w.weight);
  }
  if (mode == 0) {
    for (const SectorWeight& w : matrix.uniform) add(entry(w.row, w.column), 0, w.weight * Rational(k));
  }
  if (mode == 1) {
    for (const SectorWeight& w : matrix.harmonic) add(entry(w.row, w.column), 0, w.weight * Rational(k) / Rational(2));
  }
  if (!centre) return m;
  const std::size_t last = matrix.size();
  entry(last, last) = in_z(matrix.centre);
  for (std::size_t i = 0; i < last; ++i) {
    entry(last, i) = in_z(scaled(matrix.centre_from[i], Rational(k)));
    add(entry(i, last), 0, matrix.centre_to[i]);
  }
  return m;
}

std::vector<std::vector<std::size_t>> dependent_sets(const ModeMatrix& matrix) {
  const std::size_t n = matrix.n;
  std::vector<char> reaches(n * n);
  for (std::size_t i = 0; i < n * n; ++i) reaches[i] = !matrix.entries[i].empty();
  for (std::size_t via = 0; via < n; ++via) {
    for (std::size_t r = 0; r < n; ++r) {
      if (!reaches[r * n + via]) continue;
      for (std::size_t c = 0; c < n; ++c) reaches[r * n + c] = reaches[r * n + c] || reaches[via * n + c];
    }
  }
  std::vector<std::vector<std::size_t>> sets;
  std::vector<char> done(n);
  for (std::size_t r = 0; r < n; ++r) {
    if (done[r]) continue;
    std::vector<std::size_t> set;
    for (std::size_t c = r; c < n; ++c) {
      if (c == r || (reaches[r * n + c] && reaches[c * n + r])) set.push_back(c), done[c] = 1;
    }
    sets.push_back(std::move(set));
  }
  return sets;
}

}  // namespace hexact
