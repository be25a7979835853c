// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/midedge.hpp"

namespace hexact::detail {
// Before the templates that use them.
inline double as_double(const Rational& x) { return x.to_double(); }
inline Rational as_number(double x, const Rational*) { return Rational::from_double(x); }
}  // namespace hexact::detail

#include "hexact/kernel/midedge_keep_size_impl.hpp"

namespace hexact {

template class SizeKeeper<Rational>;

}  // namespace hexact
