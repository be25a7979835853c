// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/subdivision_matrix.hpp"

#include <compare>

namespace hexact {

/// A vertex near the extraordinary element: the vertex (i, j) of sector s + shift. The central vertex is (0, 0).
struct Place {
  int shift = 0, i = 0, j = 0;
  friend auto operator<=>(const Place&, const Place&) = default;
};

// Where the vertex with coordinates in the lattice of sector s, continued over its sides, is stored.

inline Place dual_place(int i, int j) {
  if (j < 0) return {-1, -j - 1, i};
  if (i < 0) return {1, j, -i - 1};
  return {0, i, j};
}

inline Place quad_place(int x, int y) {
  if (y < 0) return {-1, -y, x};
  if (x <= 0 && y > 0) return {1, y, -x};
  return {0, x, y};
}

inline Place triangle_place(int x, int y) {
  if (y < 0) return {-1, -y, x + y};
  if (x <= 0 && y > 0 && x + y == 0) return {2, y, 0};
  if (x <= 0 && y > 0) return {1, x + y, -x};
  return {0, x, y};
}

inline Place place(SectorLattice lattice, int x, int y) {
  return lattice == SectorLattice::dual ? dual_place(x, y) : lattice == SectorLattice::quads ? quad_place(x, y) : triangle_place(x, y);
}

}  // namespace hexact
