// SPDX-License-Identifier: LGPL-3.0-or-later
#include "interval.hpp"

#include "hexact/kernel/errors.hpp"

#include <cstdlib>

namespace hexact {
namespace {

/// least = min, greatest = max of the four products or quotients, each rounded in the direction.
template <class Operation>
void extremes(mpfr_ptr least, mpfr_ptr greatest, mpfr_srcptr al, mpfr_srcptr ah, mpfr_srcptr bl, mpfr_srcptr bh,
              Operation&& operation) {
  mpfr_t t;
  mpfr_init2(t, Interval::kBits);
  operation(least, al, bl, MPFR_RNDD), operation(greatest, al, bl, MPFR_RNDU);
  const std::array<std::array<mpfr_srcptr, 2>, 3> rest = {{{al, bh}, {ah, bl}, {ah, bh}}};
  for (const auto& [x, y] : rest) {
    operation(t, x, y, MPFR_RNDD), mpfr_min(least, least, t, MPFR_RNDD);
    operation(t, x, y, MPFR_RNDU), mpfr_max(greatest, greatest, t, MPFR_RNDU);
  }
  mpfr_clear(t);
}

}  // namespace

Interval operator*(const Interval& a, const Interval& b) {
  Interval r;
  const int s = a.sign(), t = b.sign();
  if (s != 0 && t != 0) {  // the two ends that matter are known
    const bool low_a = t > 0, low_b = s > 0;
    mpfr_mul(r.lo_, low_a ? a.lo_ : a.hi_, low_b ? b.lo_ : b.hi_, MPFR_RNDD);
    mpfr_mul(r.hi_, low_a ? a.hi_ : a.lo_, low_b ? b.hi_ : b.lo_, MPFR_RNDU);
    return r;
  }
  extremes(r.lo_, r.hi_, a.lo_, a.hi_, b.lo_, b.hi_,
           [](mpfr_ptr z, mpfr_srcptr x, mpfr_srcptr y, mpfr_rnd_t round) { mpfr_mul(z, x, y, round); });
  return r;
}

Interval operator/(const Interval& a, const Interval& b) {
  HEXACT_EXPECTS(b.sign() != 0);
  Interval r;
  extremes(r.lo_, r.hi_, a.lo_, a.hi_, b.lo_, b.hi_,
           [](mpfr_ptr z, mpfr_srcptr x, mpfr_srcptr y, mpfr_rnd_t round) { mpfr_div(z, x, y, round); });
  return r;
}

Interval Interval::cosine(int a, int k) {
  HEXACT_EXPECTS(k > 0 && 2 * std::abs(a) <= k);
  Interval angle, r;
  mpfr_const_pi(angle.lo_, MPFR_RNDD), mpfr_const_pi(angle.hi_, MPFR_RNDU);
  const Interval scaled = angle * Interval(Rational(2 * std::abs(a)) / Rational(k));
  // On [0, π] the cosine falls; beyond π by a rounding error it is within that error of −1.
  mpfr_cos(r.lo_, scaled.hi_, MPFR_RNDD), mpfr_cos(r.hi_, scaled.lo_, MPFR_RNDU);
  if (2 * std::abs(a) == k) r = Interval(-1);
  if (a == 0) r = Interval(1);
  return r;
}

}  // namespace hexact
