// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "plane_determinants.hpp"

#include <cmath>

namespace hexact::detail {

/// Sign of d − n·x for the plane f at a point x known to `error`; 0: undecided. Conversions, products and differences
/// add at most 6 roundings on the way of a term: together below 2^-50 of the sum of magnitudes.
inline int side_by_point(const IntegerPlanes& planes, std::uint32_t f, const Point3<double>& x, double error) {
  if (!planes.is_narrow(f)) return 0;
  const Row& p = planes.narrow(f);
  const double a = static_cast<double>(p[0]), b = static_cast<double>(p[1]), c = static_cast<double>(p[2]);
  const double d = static_cast<double>(p[3]), tx = a * x.x, ty = b * x.y, tz = c * x.z;
  const double value = d - tx - ty - tz;
  const double bound = ((std::fabs(a) + std::fabs(b) + std::fabs(c)) * error +
                        0x1p-50 * (std::fabs(tx) + std::fabs(ty) + std::fabs(tz) + std::fabs(d))) * (1 + 0x1p-40);
  return value > bound ? 1 : value < -bound ? -1 : 0;
}

}  // namespace hexact::detail
