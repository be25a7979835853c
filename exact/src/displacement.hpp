// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "facet_geometry.hpp"

#include <cmath>
#include <limits>
#include <vector>

namespace hexact::detail {

/// A double that is at least the distance of p and q, computed from its exact square.
template <class S>
double distance_bound(const Point3<S>& p, const Point3<S>& q) {
  const Point3<S> d = p - q;
  const S squared = dot(d, d);
  if (squared.sign() == 0) return 0;
  const double infinity = std::numeric_limits<double>::infinity();
  const double above = std::nextafter(squared.to_double(), infinity);  // to_double is within half a unit
  return std::nextafter(std::sqrt(above), infinity);                   // so is sqrt
}

template <class S>
double largest_distance(const std::vector<Point3<S>>& ps, const std::vector<Point3<S>>& qs) {
  double largest = 0;
  for (std::size_t i = 0; i < ps.size(); ++i) largest = std::max(largest, distance_bound(ps[i], qs[i]));
  return largest;
}

}  // namespace hexact::detail
