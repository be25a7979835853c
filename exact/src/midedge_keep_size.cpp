// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/midedge.hpp"

#include <climits>

namespace hexact::detail {
// Before the templates that use them.
inline int binary_exponent(const Rational& x) {
  if (sign(x) == 0) return INT_MIN;
  return static_cast<int>(static_cast<long>(x.numerator().bit_length()) - static_cast<long>(x.denominator().bit_length())) + 1;
}
inline double as_double(const Rational& x, int exponent) { return x.scaled(-exponent).to_double(); }
inline Rational times_power_of_two(const Rational& x, int exponent) { return x.scaled(exponent); }
inline bool is_finite(const Rational&) { return true; }
inline Rational as_number(double x, const Rational*) { return Rational::from_double(x); }
}  // namespace hexact::detail

#include "hexact/kernel/midedge_keep_size_impl.hpp"

namespace hexact {

template class SizeKeeper<Rational>;

}  // namespace hexact
