// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/spectrum.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace hexact {

/// What a spectral certificate may state, but for the last of one valence k.
/// ordering: 1 > λ₂ = λ₃ > |λ₄|, with multiplicities; ordering_fails: the eigenvalues contradict that.
/// ring: the characteristic map is regular and injective on its ring; ring_fails: the ordering holds and λ₂ belongs to
/// a mode 1 < m < k/2, so that the ring winds m times.
/// c1: limit surfaces of generic data are C¹ (ordering and ring); c1_fails: they are not (ring_fails).
/// regular: how smooth limits are where the mesh is regular, as the block `regular` says; of no valence.
enum class SpectrumClaimKind { ordering, ring, c1, ordering_fails, ring_fails, c1_fails, regular };

struct SpectrumClaim {
  SpectrumClaimKind kind = SpectrumClaimKind::ordering;
  int valence = 0;  ///< 0: of none
  friend bool operator==(const SpectrumClaim&, const SpectrumClaim&) = default;
};

/// "ordering=5", "ring-fails=7" and so on, "regular".
[[nodiscard]] std::string text_of(const SpectrumClaim& claim);
/// The claim that has this text; none if there is no such claim.
[[nodiscard]] std::optional<SpectrumClaim> spectrum_claim(std::string_view text);

/// What a row proves, one way or the other; what is undecided yields no claim.
[[nodiscard]] std::vector<SpectrumClaim> proved_claims(const SpectrumRow& row);

}  // namespace hexact
