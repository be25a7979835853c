// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/regular_smoothness.hpp"
#include "hexact/exact/spectrum.hpp"
#include "hexact/exact/spectrum_claims.hpp"
#include "hexact/exact/spectrum_masks.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hexact {

/// What a second program needs to prove a table again: what is claimed, and the numbers that were hard to find.
struct SpectrumCertificate {
  /// Of a proof of the ring: its level and its proven bounds, see `RingProof`.
  struct Ring {
    int level = 0;
    Rational jacobian, half_plane;
  };
  struct Row {
    int valence = 0;
    std::optional<ExtraordinaryMask> mask;  ///< in place of the scheme's rule; always there for blocks
    RationalInterval cosine;                ///< contains cos(2π/k)
    std::vector<ModeSpectrum> modes;        ///< all eigenvalues of the modes 0 … k/2
    std::optional<Ring> ring;               ///< where the ring is claimed
  };
  std::vector<std::string> provenance;  ///< for information
  std::optional<SpectrumScheme> scheme = SpectrumScheme::midedge6;  ///< none: rows give blocks
  std::vector<SpectrumClaim> claims;
  std::vector<Row> rows;
  std::optional<RegularEvidence> regular;  ///< of regular regions, where their smoothness is claimed
};

/// The certificate of what the rows prove, one way or the other: `proved_claims` of each row, in order. Left out are
/// rows that prove nothing, and an ordering that rests on a bound of complex or clustered eigenvalues, if no such
/// bound is found that `verify` accepts; with it goes what rests on it.
[[nodiscard]] SpectrumCertificate make_spectrum_certificate(SpectrumScheme scheme, const std::vector<SpectrumRow>& rows,
                                                            std::vector<std::string> provenance);
/// The same for rows of masks, which stand in the certificate. Of blocks only the ordering is claimed, as nothing is
/// known of the rules elsewhere. Precondition: there is a mask of each row's valence.
[[nodiscard]] SpectrumCertificate make_spectrum_certificate(const MasksDocument& masks, const std::vector<SpectrumRow>& rows,
                                                            std::vector<std::string> provenance);

/// Decides each claim from the certificate's numbers alone, the matrices being made anew. Claims of rows rest on this: the
/// cosine interval is narrow and right (zeros of a Chebyshev polynomial, counted by Sturm's theorem) and the listed
/// eigenvalues are all there are, with these multiplicities, but for some in a disc (see docs/spectrum.md).
/// Then `ordering`, `ordering-fails`: what follows from the list, see `decide_ordering`; `ring`: the bounds of
/// `prove_ring` at this level are positive and hold; `ring-fails`: λ₂ is of a mode between 1 and k/2; `c1`: ordering and
/// ring; `c1-fails`: ring-fails. `regular` rests on its own evidence, see `regular_fault`. Refuted with a witness when the proof is not there.
[[nodiscard]] std::vector<ClaimVerdict> verify(const SpectrumCertificate& certificate);

/// Whether an interval contains cos(2π/k) and no other zero of the Chebyshev polynomial U_{k−1}, whose zeros are
/// cos(jπ/k): exactly two zeros are greater than lo and one greater than hi. Precondition: k >= 3.
[[nodiscard]] bool encloses_cosine(const RationalInterval& interval, int k);

}  // namespace hexact
