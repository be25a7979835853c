// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/eigenvalues.hpp"

#include <nlohmann/json.hpp>

#include <fstream>
#include <string>
#include <vector>

namespace hexact::test {

inline const nlohmann::json& midedge_golden() {
  static const nlohmann::json document = nlohmann::json::parse(std::ifstream(std::string(HEXACT_TEST_DATA) + "/midedge_golden.json"));
  return document;
}

inline Rational rational(const std::string& text) {
  Rational r;
  if (Rational::parse(text, r) != Rational::ParseResult::ok) throw std::invalid_argument(text);
  return r;
}

using Line = std::vector<Rational>;  ///< coefficients of a polynomial, constant first

inline Line times(const Line& p, const Line& q) {
  if (p.empty() || q.empty()) return {};
  Line r(p.size() + q.size() - 1);
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = 0; j < q.size(); ++j) r[i + j] += p[i] * q[j];
  }
  return r;
}

inline Rational at(const Line& p, const Rational& x) {
  Rational v;
  for (std::size_t i = p.size(); i-- > 0;) v = v * x + p[i];
  return v;
}

/// The characteristic polynomial at a rational c.
inline Line at_cosine(const std::vector<CharacteristicFactor>& factors, const Rational& c) {
  Line product{Rational(1)};
  for (const CharacteristicFactor& f : factors) {
    Line p;
    for (const CosinePolynomial& a : f.coefficients) p.push_back(at(a, c));
    product = times(product, p);
  }
  return product;
}

inline Line monic(Line p) {
  const Rational lead = p.back();
  for (Rational& x : p) x /= lead;
  return p;
}

/// The polynomial with these integers as coefficients, constant first, divided by the last.
inline Line polynomial(const std::vector<long>& coefficients) {
  Line p;
  for (const long x : coefficients) p.push_back(Rational(x));
  return monic(p);
}

inline Line power(const Line& p, int n) { return n == 0 ? Line{Rational(1)} : times(p, power(p, n - 1)); }

}  // namespace hexact::test
