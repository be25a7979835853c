// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/plane_body.hpp"

namespace hexact {

void IntegerPlanes::push_back(const Plane<Integer>& plane) {
  narrow_.emplace_back();
  set(narrow_.size() - 1, plane);
}

void IntegerPlanes::set(std::size_t i, const Plane<Integer>& plane) {
  // 62 bits leave room for sums of two terms; the minimum of int64 marks a wide plane.
  constexpr std::size_t kNarrowBits = 62;
  if (plane.a.bit_length() <= kNarrowBits && plane.b.bit_length() <= kNarrowBits &&
      plane.c.bit_length() <= kNarrowBits && plane.d.bit_length() <= kNarrowBits) {
    narrow_[i] = {plane.a.to_int64(), plane.b.to_int64(), plane.c.to_int64(), plane.d.to_int64()};
    return;
  }
  narrow_[i] = {static_cast<std::int64_t>(wide_.size()), 0, 0, kWide};
  wide_.push_back(plane);
}

Plane<Integer> IntegerPlanes::operator[](std::size_t i) const {
  if (!is_narrow(i)) return wide(i);
  const Narrow& p = narrow_[i];
  return {Integer(p[0]), Integer(p[1]), Integer(p[2]), Integer(p[3])};
}

}  // namespace hexact
