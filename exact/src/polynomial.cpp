// SPDX-License-Identifier: LGPL-3.0-or-later
#include "polynomial.hpp"

#include "hexact/kernel/errors.hpp"

namespace hexact {

Polynomial trimmed(Polynomial p) {
  while (!p.empty() && p.back().is_zero()) p.pop_back();
  return p;
}

Polynomial sum(const Polynomial& p, const Polynomial& q) {
  Polynomial r = p.size() < q.size() ? q : p;
  const Polynomial& shorter = p.size() < q.size() ? p : q;
  for (std::size_t i = 0; i < shorter.size(); ++i) r[i] += shorter[i];
  return trimmed(std::move(r));
}

Polynomial difference(const Polynomial& p, const Polynomial& q) { return sum(p, scaled(q, Rational(-1))); }

Polynomial product(const Polynomial& p, const Polynomial& q) {
  if (p.empty() || q.empty()) return {};
  Polynomial r(p.size() + q.size() - 1);
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j < q.size(); ++j) r[i + j] += p[i] * q[j];
  }
  return r;
}

Polynomial scaled(const Polynomial& p, const Rational& factor) {
  if (factor.is_zero()) return {};
  Polynomial r = p;
  for (Rational& x : r) x *= factor;
  return r;
}

Polynomial derivative(const Polynomial& p) {
  Polynomial r;
  for (std::size_t i = 1; i < p.size(); ++i) r.push_back(p[i] * Rational(static_cast<long>(i)));
  return r;
}

Polynomial monic(const Polynomial& p) {
  HEXACT_EXPECTS(!p.empty());
  return scaled(p, Rational(1) / p.back());
}

Rational value(const Polynomial& p, const Rational& x) {
  Rational v;
  for (std::size_t i = p.size(); i-- > 0;) v = v * x + p[i];
  return v;
}

std::pair<Polynomial, Polynomial> divided(const Polynomial& p, const Polynomial& q) {
  HEXACT_EXPECTS(!q.empty());
  if (p.size() < q.size()) return {{}, p};
  Polynomial rest = p, quotient(p.size() - q.size() + 1);
  for (std::size_t i = quotient.size(); i-- > 0;) {
    quotient[i] = rest[i + q.size() - 1] / q.back();
    for (std::size_t j = 0; j < q.size(); ++j) rest[i + j] -= quotient[i] * q[j];
  }
  return {trimmed(std::move(quotient)), trimmed(std::move(rest))};
}

Polynomial common_divisor(Polynomial p, Polynomial q) {
  while (!q.empty()) {
    Polynomial rest = divided(p, q).second;
    p = std::move(q);
    q = rest.empty() ? Polynomial() : monic(rest);
  }
  return p.empty() ? p : monic(p);
}

std::vector<SquareFreeFactor> square_free_factors(const Polynomial& p) {
  HEXACT_EXPECTS(!p.empty());
  std::vector<SquareFreeFactor> out;
  const Polynomial slope = derivative(p);
  Polynomial common = common_divisor(p, slope);
  Polynomial b = divided(monic(p), common).first;
  Polynomial c = divided(scaled(slope, Rational(1) / p.back()), common).first;
  for (int multiplicity = 1; b.size() > 1; ++multiplicity) {
    const Polynomial d = difference(c, derivative(b));
    const Polynomial factor = common_divisor(b, d);
    if (factor.size() > 1) out.push_back({factor, multiplicity});
    b = divided(b, factor).first;
    c = d.empty() ? Polynomial() : divided(d, factor).first;
  }
  return out;
}

Polynomial interpolated(const std::vector<Rational>& nodes, const std::vector<Rational>& values) {
  HEXACT_EXPECTS(nodes.size() == values.size());
  std::vector<Rational> slopes = values;  // Newton's divided differences, in place
  for (std::size_t order = 1; order < nodes.size(); ++order) {
    for (std::size_t i = nodes.size() - 1; i >= order; --i) {
      slopes[i] = (slopes[i] - slopes[i - 1]) / (nodes[i] - nodes[i - order]);
    }
  }
  Polynomial p;
  for (std::size_t i = nodes.size(); i-- > 0;) {
    p = sum(product(p, {-nodes[i], Rational(1)}), trimmed({slopes[i]}));
  }
  return p;
}

Polynomial characteristic_polynomial(const std::vector<Rational>& matrix, std::size_t n) {
  HEXACT_EXPECTS(matrix.size() == n * n);
  Integer denominator(1);
  for (const Rational& x : matrix) denominator = lcm(denominator, x.denominator());
  std::vector<Integer> a;
  for (const Rational& x : matrix) a.push_back((x * Rational(denominator)).numerator());
  std::vector<Integer> coefficients(n + 1);
  coefficients[n] = Integer(1);
  std::vector<Integer> power(n * n);  // the matrix M_j of Faddeev and LeVerrier
  for (std::size_t j = 1; j <= n; ++j) {
    std::vector<Integer> next(n * n);
    for (std::size_t r = 0; r < n; ++r) power[r * n + r] += coefficients[n - j + 1];
    Integer trace(0);
    for (std::size_t r = 0; r < n; ++r) {
      for (std::size_t i = 0; i < n; ++i) {
        if (a[r * n + i].is_zero()) continue;
        for (std::size_t c = 0; c < n; ++c) mpz_addmul(next[r * n + c].raw(), a[r * n + i].raw(), power[i * n + c].raw());
      }
      trace += next[r * n + r];
    }
    coefficients[n - j] = exact_quotient(-trace, Integer(static_cast<long>(j)));
    power = std::move(next);
  }
  Polynomial p(n + 1);
  Rational scale(1);
  for (std::size_t j = 0; j <= n; ++j, scale /= Rational(denominator)) p[n - j] = Rational(coefficients[n - j]) * scale;
  return p;
}

}  // namespace hexact
