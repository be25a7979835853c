// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/subdivision_matrix.hpp"

#include <vector>

namespace hexact {

/// A closed interval with rational ends.
struct RationalInterval {
  Rational lo, hi;
  friend bool operator==(const RationalInterval&, const RationalInterval&) = default;
};

/// A monic factor of the characteristic polynomial of mode m in the eigenvalue L, with c = cos(2π angle/k): the
/// coefficient of L^i stands at place i, as a polynomial in c. Every coefficient has degree 0 where c does not matter.
struct CharacteristicFactor {
  int angle = 0;
  std::vector<CosinePolynomial> coefficients;
};

/// Factors whose product is the characteristic polynomial of the matrix on the vectors with u(s) = e^{2πi ms/k} u(0):
/// one or two (the second without dependence on c) for each set of vertices that depend on each other.
/// Throws InvalidInput (NotSymmetric) if a coefficient is no polynomial in c, which mirror images exclude.
/// Throws ResourceLimit if a set costs more than about 2^30 products of words (docs/spectrum.md, Limits).
/// Precondition: 0 <= mode <= k/2. Cost: interpolation over two integer matrices for each vertex of a set and each sector
/// that it reaches; sets of one vertex need none.
[[nodiscard]] std::vector<CharacteristicFactor> characteristic_factors(const SubdivisionMatrix& matrix, int mode);

/// Those of the modes 0 … k/2. The modes from 2 on have the same polynomials, each in its own cosine, and mode 1 has them
/// too unless weights are harmonic: they are found once.
[[nodiscard]] std::vector<std::vector<CharacteristicFactor>> characteristic_factors(const SubdivisionMatrix& matrix);

/// cos(2π angle/k) where it is rational: at 0, 1/6, 1/4, 1/3 and 1/2 of a turn; then `found` is true.
struct RationalCosine {
  bool found = false;
  Rational value;
};
[[nodiscard]] RationalCosine rational_cosine(int angle, int k);

/// Real eigenvalues of one mode.
struct Eigenvalue {
  int mode = 0;
  RationalInterval enclosure;  ///< one number where both ends are equal, else of width 2^-104 and with ends of other sign
  int multiplicity = 1;        ///< algebraic, of this number (equal ends) or of the one number inside, in this mode
};

/// All that was proved of the eigenvalues of a mode: `isolated` in decreasing order; and `remaining` further
/// ones, real or not, that no isolating interval was found for. Intervals of one factor are disjoint; one may meet an
/// eigenvalue of another factor, even be the same number, as where a polynomial in an irrational cosine is 1/4.
struct ModeSpectrum {
  std::vector<Eigenvalue> isolated;
  int remaining = 0;
  /// |L| <= bound for the remaining ones.
  Rational remaining_bound;
};

/// Isolates the eigenvalues of a mode. Rational eigenvalues are found and divided out exactly; where c is rational,
/// multiple factors are separated exactly (Yun); the rest is proved by changes of sign at rational ends, with c in an
/// interval. Cost: milliseconds per mode.
[[nodiscard]] ModeSpectrum mode_spectrum(const SubdivisionMatrix& matrix, int mode);

/// Those of the modes 0 … k/2, from polynomials that are found once. Cost: O(k) times that of one mode.
[[nodiscard]] std::vector<ModeSpectrum> mode_spectra(const SubdivisionMatrix& matrix);

}  // namespace hexact
