// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/symbol.hpp"

#include "hexact/kernel/errors.hpp"

#include <algorithm>

namespace hexact {

Symbol Symbol::monomial(const Vector& v, const Rational& weight) {
  Symbol p;
  p.add(v, weight);
  return p;
}

void Symbol::add(const Vector& v, const Rational& weight) {
  if (weight.is_zero()) return;
  const auto [at, is_new] = terms_.try_emplace(v, weight);
  if (is_new) return;
  at->second += weight;
  if (at->second.is_zero()) terms_.erase(at);
}

Rational Symbol::coefficient(const Vector& v) const {
  const auto at = terms_.find(v);
  return at == terms_.end() ? Rational() : at->second;
}

bool Symbol::has_negative_coefficient() const {
  return std::any_of(terms_.begin(), terms_.end(), [](const auto& term) { return term.second.sign() < 0; });
}

Rational Symbol::total() const {
  Rational sum;
  for (const auto& [v, weight] : terms_) sum += weight;
  return sum;
}

Symbol Symbol::mapped(const Vector& first, const Vector& second) const {
  Symbol p;
  for (const auto& [v, weight] : terms_) p.add({v[0] * first[0] + v[1] * second[0], v[0] * first[1] + v[1] * second[1]}, weight);
  return p;
}

Symbol Symbol::shifted(const Vector& v) const { return *this * monomial(v); }

std::optional<Symbol> Symbol::without(const Vector& direction) const {
  HEXACT_EXPECTS(direction != (Vector{0, 0}));
  // Along `direction`, first the terms that come first: each is in the quotient what the ones before have left of it.
  const auto place = [&](const Vector& v) { return v[0] * direction[0] + v[1] * direction[1]; };
  if (terms_.empty()) return Symbol();
  const auto last = std::max_element(terms_.begin(), terms_.end(), [&](const auto& a, const auto& b) { return place(a.first) < place(b.first); });
  const int end = place(last->first);
  Symbol rest = *this, quotient;
  while (!rest.terms_.empty()) {
    const auto first = std::min_element(rest.terms_.begin(), rest.terms_.end(), [&](const auto& a, const auto& b) { return place(a.first) < place(b.first); });
    const auto [v, weight] = *first;
    const Vector next{v[0] + direction[0], v[1] + direction[1]};
    if (place(next) > end) return std::nullopt;
    quotient.add(v, weight);
    rest.add(v, -weight);
    rest.add(next, -weight);
  }
  return quotient;
}

Symbol operator+(const Symbol& p, const Symbol& q) {
  Symbol sum = p;
  for (const auto& [v, weight] : q.terms_) sum.add(v, weight);
  return sum;
}

Symbol operator*(const Symbol& p, const Symbol& q) {
  Symbol product;
  for (const auto& [v, a] : p.terms_) {
    for (const auto& [u, b] : q.terms_) product.add({v[0] + u[0], v[1] + u[1]}, a * b);
  }
  return product;
}

int zero_order(const Symbol& p, int s, int t) {
  HEXACT_EXPECTS(!p.terms().empty() && s * s == 1 && t * t == 1);
  const auto power = [](int base, int exponent) {
    Rational x(1);
    for (int i = 0; i < exponent; ++i) x *= Rational(base);
    return x;
  };
  for (int order = 0;; ++order) {
    for (int a = 0; a <= order; ++a) {  // (z ∂z)^a (w ∂w)^(order − a)
      Rational moment;
      for (const auto& [v, weight] : p.terms()) {
        const bool odd = (s < 0 && v[0] % 2 != 0) != (t < 0 && v[1] % 2 != 0);
        const Rational term = weight * power(v[0], a) * power(v[1], order - a);
        moment += odd ? -term : term;
      }
      if (!moment.is_zero()) return order;
    }
  }
}

}  // namespace hexact
