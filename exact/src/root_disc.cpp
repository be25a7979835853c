// SPDX-License-Identifier: LGPL-3.0-or-later
#include "root_disc.hpp"

namespace hexact {
namespace {

/// Whether all roots of p have modulus below r, for certain (Schur 1918, Cohn 1922): scaled to the unit disc, each
/// reduction p → (a_n p − a_0 p*)/x keeps the number of roots inside as long as |a_n| > |a_0|.
bool inside_disc(std::vector<Interval> p, const Rational& r) {
  Interval scale(1);
  for (Interval& a : p) a = a * scale, scale = scale * Interval(r);
  while (p.size() > 1) {
    const Interval last = p.back(), first = p.front();
    if ((square(last) - square(first)).sign() <= 0) return false;
    std::vector<Interval> next;
    for (std::size_t i = 1; i < p.size(); ++i) next.push_back(last * p[i] - first * p[p.size() - 1 - i]);
    const Interval size = next.back().middle();
    for (Interval& a : next) a = a / size;
    p = std::move(next);
  }
  return true;
}

std::vector<Interval> without_root(const std::vector<Interval>& p, const Interval& x) {
  std::vector<Interval> q(p.size() - 1);
  Interval carry(0);
  for (std::size_t i = p.size() - 1; i-- > 0;) carry = q[i] = carry * x + p[i + 1];
  return q;
}

}  // namespace

Rational remaining_root_bound(const std::vector<Interval>& p, const std::vector<RationalInterval>& isolated) {
  std::vector<Interval> rest = p;
  for (const RationalInterval& r : isolated) rest = without_root(rest, Interval(r.lo, r.hi));
  Rational cauchy(1);
  for (std::size_t i = 0; i + 1 < rest.size(); ++i) {
    const Rational a = std::max(abs(rest[i].lower()), abs(rest[i].upper())) + Rational(1);
    cauchy = std::max(cauchy, a);
  }
  constexpr long kBits = 16;
  Integer low(0), high(1L << 18);  // in units of 2^-16: inside at high, not proved at low
  if (!inside_disc(rest, Rational(high).scaled(-kBits))) return cauchy;
  while (high - low > Integer(1)) {
    const Integer middle = floor_quotient(low + high, Integer(2));
    (inside_disc(rest, Rational(middle).scaled(-kBits)) ? high : low) = middle;
  }
  return Rational(high).scaled(-kBits);
}

}  // namespace hexact
