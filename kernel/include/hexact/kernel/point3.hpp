// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

namespace hexact {

/// A point or vector with coordinates in the field S.
template <class S>
struct Point3 {
  S x{}, y{}, z{};
  friend bool operator==(const Point3&, const Point3&) = default;
};

}  // namespace hexact
