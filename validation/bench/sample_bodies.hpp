// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"

#include <array>
#include <initializer_list>
#include <string>

namespace bench {

inline void add_loop(hexact::PlaneBody& body, std::initializer_list<int> loop) {
  for (const int v : loop) body.loops.add_corner(hexact::make_id<hexact::VertexId>(static_cast<std::size_t>(v)));
  body.loops.close_loop();
}

inline hexact::PlaneBody box(const std::array<hexact::IntegerPlanes::Narrow, 6>& planes) {
  hexact::PlaneBody body;
  for (const auto& p : planes) body.planes.push_back(p);
  for (const auto& loop : {std::initializer_list<int>{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}) {
    add_loop(body, loop);
  }
  body.addresses.resize(6);
  body.triples.resize(8);
  return body;
}

inline hexact::PlaneBody tetrahedron() {
  hexact::PlaneBody body;
  for (const auto& p : {hexact::IntegerPlanes::Narrow{-1, -1, -1, 1}, {-1, 1, 1, 1}, {1, -1, 1, 1}, {1, 1, -1, 1}}) {
    body.planes.push_back(p);
  }
  for (const auto& loop : {std::initializer_list<int>{3, 2, 1}, {2, 3, 0}, {3, 1, 0}, {1, 2, 0}}) add_loop(body, loop);
  body.addresses.resize(4);
  body.triples.resize(4);
  return body;
}

/// tetrahedron, generic (a combinatorial cube without symmetry), or else the cube [−1, 1]³.
inline hexact::PlaneBody base_of(const std::string& shape) {
  if (shape == "tetrahedron") return tetrahedron();
  if (shape == "generic") {
    return box({{{-41, 3, -7, 40}, {43, -5, 2, 44}, {4, -39, 6, 41}, {-3, 45, 8, 43}, {5, -2, -42, 39}, {-6, 7, 44, 45}}});
  }
  return box({{{-1, 0, 0, 1}, {1, 0, 0, 1}, {0, -1, 0, 1}, {0, 1, 0, 1}, {0, 0, -1, 1}, {0, 0, 1, 1}}});
}

}  // namespace bench
