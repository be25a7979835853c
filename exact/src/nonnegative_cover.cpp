// SPDX-License-Identifier: LGPL-3.0-or-later
#include "nonnegative_cover.hpp"

#include "hexact/kernel/errors.hpp"

#include <algorithm>

namespace hexact {
namespace {

using Row = std::vector<Rational>;

/// row -= factor · other.
void subtract(Row& row, const Row& other, const Rational& factor) {
  for (std::size_t j = 0; j < row.size(); ++j) row[j] -= factor * other[j];
}

/// The row whose constraint holds first when variable `column` grows; of several the one with the smallest variable.
std::optional<std::size_t> leaving_row(const std::vector<Row>& rows, const std::vector<std::size_t>& basis, std::size_t column) {
  std::optional<std::size_t> best;
  Rational least;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i][column].sign() <= 0) continue;
    const Rational ratio = rows[i].back() / rows[i][column];
    if (best && (ratio > least || (ratio == least && basis[i] > basis[*best]))) continue;
    best = i;
    least = ratio;
  }
  return best;
}

}  // namespace

std::optional<Cover> least_cover(const std::vector<Rational>& y, const std::vector<std::vector<Rational>>& points) {
  const std::size_t n = y.size(), m = points.size();
  // Rows: points[i]·x + slack_i = 1. The objective's row holds −y; where the slack of row i stands in it at the end is
  // the multiplier of the constraint, which is the weight of the point.
  std::vector<Row> rows;
  std::vector<std::size_t> basis;
  for (std::size_t i = 0; i < m; ++i) {
    HEXACT_EXPECTS(points[i].size() == n);
    Row row = points[i];
    row.resize(n + m + 1);
    row[n + i] = row.back() = Rational(1);
    rows.push_back(std::move(row));
    basis.push_back(n + i);
  }
  Row objective(n + m + 1);
  for (std::size_t j = 0; j < n; ++j) objective[j] = -y[j];
  for (;;) {
    const auto negative = std::find_if(objective.begin(), objective.end() - 1, [](const Rational& x) { return x.sign() < 0; });
    if (negative == objective.end() - 1) break;
    const auto column = static_cast<std::size_t>(negative - objective.begin());
    const std::optional<std::size_t> leaving = leaving_row(rows, basis, column);
    if (!leaving) return std::nullopt;  // unbounded
    Row& pivot = rows[*leaving];
    const Rational lead = pivot[column];
    for (Rational& x : pivot) x /= lead;
    for (std::size_t i = 0; i < m; ++i) {
      if (i != *leaving && !rows[i][column].is_zero()) subtract(rows[i], pivot, Rational(rows[i][column]));
    }
    subtract(objective, pivot, Rational(objective[column]));
    basis[*leaving] = column;
  }
  return Cover{objective.back(), {objective.begin() + static_cast<std::ptrdiff_t>(n), objective.end() - 1}};
}

}  // namespace hexact
