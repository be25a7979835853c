// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/rational.hpp"

#include <array>
#include <cstddef>
#include <string>
#include <vector>

namespace hexact {

/// Schemes whose spectra are known here. midedge and midedge6 count double steps, as all others single ones.
enum class SpectrumScheme { midedge, midedge6, loop, catmull_clark, doo_sabin };

/// "midedge6", "catmull-clark" and so on.
[[nodiscard]] const char* name_of(SpectrumScheme scheme) noexcept;

/// How the k-fold symmetric surroundings of the extraordinary element are made of vertices.
/// dual: a k-gon, and in sector s the vertices (i, j) at (i + 1/2, j + 1/2), i, j >= 0.
/// quads: a k-valent vertex, and in sector s the vertices (i, j) with i >= 1, j >= 0 of a quad mesh; axis s is j = 0.
/// triangles: the same in a triangle mesh, sector s spanned by the axes s and s + 1.
enum class SectorLattice { dual, quads, triangles };

/// The weight of the coarse vertex `column` of sector s + `shift` in the fine vertex `row` of sector s, any s.
struct SectorWeight {
  std::size_t row = 0, column = 0;
  int shift = 0;
  Rational weight;
};

/// A polynomial in c = cos(2π/k), coefficient of the i-th power at place i.
using CosinePolynomial = std::vector<Rational>;

/// One step around an extraordinary element of valence (or face size) k, restricted to the vertices near it that
/// determine themselves. Weights of a row are the sum of what the lists below say of it.
struct SubdivisionMatrix {
  std::string scheme;
  SectorLattice lattice = SectorLattice::dual;
  int valence = 0;                                ///< k >= 3
  std::vector<std::array<int, 2>> vertices;       ///< (i, j) of the vertices of one sector, by number
  std::vector<SectorWeight> local;                ///< single weights
  std::vector<SectorWeight> uniform;              ///< the same weight for the column in every sector; shift unused
  std::vector<SectorWeight> harmonic;             ///< weight · cos(2π d/k) for the column in sector s + d, every d
  bool has_centre = false;                        ///< whether there is a central vertex
  CosinePolynomial centre;                        ///< its weight in itself
  std::vector<CosinePolynomial> centre_from;      ///< by column, for every sector: weight in the central vertex
  std::vector<Rational> centre_to;                ///< by row: weight of the central vertex

  [[nodiscard]] std::size_t size() const noexcept { return vertices.size(); }
  /// Number of (i, j) in `vertices`, or size() if it is not there.
  [[nodiscard]] std::size_t index(int i, int j) const noexcept;
};

/// The matrix on `reach` rings: i, j < reach (dual), i, j <= reach (quads), i + j <= reach (triangles).
/// Masks: Peters and Reif 1997 (midedge), the six-point rule (midedge6), Doo and Sabin 1978, Catmull and Clark 1978,
/// Loop 1987. Throws InvalidInput (BadValence) when valence < 3, (BadReach) when the vertices would not determine
/// themselves: reach >= 2 for midedge, 3 for midedge6 and Doo–Sabin and the others.
[[nodiscard]] SubdivisionMatrix subdivision_matrix(SpectrumScheme scheme, int valence, int reach);

/// The smallest reach that determines the ring of the characteristic map: 3, and 4 for midedge6.
[[nodiscard]] int ring_reach(SpectrumScheme scheme) noexcept;

/// Whether the weights of every row add up to 1, so that constant data stays constant. The program's own schemes do.
[[nodiscard]] bool reproduces_constants(const SubdivisionMatrix& matrix);

/// The block D_d of the block-circulant part: the entry at row · size() + column is the weight of the coarse vertex
/// `column` of sector d in the fine vertex `row` of sector 0, a polynomial in cos(2π/k), reduced by nothing.
[[nodiscard]] std::vector<CosinePolynomial> sector_block(const SubdivisionMatrix& matrix, int d);

}  // namespace hexact
