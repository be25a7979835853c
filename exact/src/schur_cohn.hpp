// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace hexact {

/// How many roots a polynomial has with |z| < 1, counted with multiplicities (Schur 1918, Cohn 1922); nothing when a
/// step cannot be decided, as with a root on the circle. Numbers are Rational, or intervals with a certain sign.
///
/// On the circle p and its reverse p* have the same modulus. So by Rouché a_n p − a_0 p* has as many roots inside as p
/// when |a_n| > |a_0|, one of which is 0 and is divided out; and so has a_0 p − a_n p*, whose degree is smaller, when
/// |a_0| > |a_n|. Coefficients are divided by one of them in each step, so that their size grows with the degree only.
template <class Number, class Normalise>
[[nodiscard]] std::optional<std::size_t> roots_in_unit_disc(std::vector<Number> p, const Normalise& normalised) {
  std::size_t inside = 0;
  while (p.size() > 1) {
    const std::size_t n = p.size() - 1;
    const Number first = p.front(), last = p.back();
    const int order = (last * last - first * first).sign();
    if (order == 0) return std::nullopt;
    std::vector<Number> next;
    for (std::size_t i = 0; i < n; ++i) {
      next.push_back(order > 0 ? last * p[i + 1] - first * p[n - 1 - i] : first * p[i] - last * p[n - i]);
    }
    if (order > 0) ++inside;
    p = normalised(std::move(next), order > 0 ? n - 1 : 0);
  }
  if (p.empty() || p.front().sign() == 0) return std::nullopt;
  return inside;
}

/// The same for |z| < r. `normalised(p, i)` returns p divided by a number near p[i], which is not 0.
template <class Number, class Normalise>
[[nodiscard]] std::optional<std::size_t> roots_in_disc(std::vector<Number> p, const Number& r, const Normalise& normalised) {
  Number power(1);
  for (Number& a : p) {
    a = a * power;
    power = power * r;
  }
  return roots_in_unit_disc(std::move(p), normalised);
}

}  // namespace hexact
