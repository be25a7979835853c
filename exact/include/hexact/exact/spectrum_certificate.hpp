// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/spectrum.hpp"

#include <string>
#include <vector>

namespace hexact {

/// What a second program needs to prove a table again: the numbers that were hard to find.
struct SpectrumCertificate {
  struct Row {
    int valence = 0;
    RationalInterval cosine;                      ///< contains cos(2π/k)
    std::vector<std::vector<Eigenvalue>> modes;   ///< all eigenvalues of the modes 0 … k/2
    int level = 0;                                ///< of the proof of the ring
    Rational jacobian, half_plane;                ///< its proven bounds
  };
  std::vector<std::string> provenance;  ///< for information
  SpectrumScheme scheme = SpectrumScheme::midedge6;
  std::vector<Row> rows;
};

/// The certificate of rows that are all proved. Throws InvalidInput (NotProved) naming a row that is not.
[[nodiscard]] SpectrumCertificate make_spectrum_certificate(SpectrumScheme scheme, const std::vector<SpectrumRow>& rows,
                                                            std::vector<std::string> provenance);

/// Decides from the certificate's numbers alone, for each row, `ordering=K`: the cosine interval is narrow and right
/// (zeros of a Chebyshev polynomial, counted by Sturm's theorem), the listed eigenvalues are all there are, with these
/// multiplicities (rational ones by exact division, the others by changes of sign), and 1 > λ₂ = λ₃ > |λ₄|;
/// `ring=K`: the bounds of `prove_ring` at this level are positive and hold; `c1=K`: both.
/// Refuted with a witness when the proof is not there.
[[nodiscard]] std::vector<ClaimVerdict> verify(const SpectrumCertificate& certificate);

/// Whether an interval contains cos(2π/k) and no other zero of the Chebyshev polynomial U_{k−1}, whose zeros are
/// cos(jπ/k): exactly two zeros are greater than lo and one greater than hi. Precondition: k >= 3.
[[nodiscard]] bool encloses_cosine(const RationalInterval& interval, int k);

}  // namespace hexact
