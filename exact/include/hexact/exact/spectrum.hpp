// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/characteristic_ring.hpp"
#include "hexact/exact/eigenvalues.hpp"
#include "hexact/exact/subdivision_matrix.hpp"
#include "hexact/exact/verdict.hpp"
#include "hexact/kernel/progress.hpp"

#include <optional>
#include <string>
#include <vector>

namespace hexact {

/// A matrix and the regular rules around it.
struct SpectrumSubject {
  SubdivisionMatrix matrix;
  std::optional<SpectrumScheme> regular;  ///< whose rules hold away from the centre; none: the ring is not known
};

/// The subject of a scheme of this program, on as many vertices as determine the ring.
[[nodiscard]] SpectrumSubject scheme_subject(SpectrumScheme scheme, int valence);

/// One valence: all eigenvalues and what was proved.
struct SpectrumRow {
  int valence = 0;
  /// Modes 0 … k/2; eigenvalues of a mode m with 0 < m < k/2 are those of mode k − m too.
  std::vector<ModeSpectrum> modes;
  std::optional<Eigenvalue> subdominant;  ///< λ₂ = λ₃ when the ordering is proved
  std::optional<Eigenvalue> next;         ///< the one of greatest modulus after these, if that is isolated
  Verdict ordering = Verdict::undecided;  ///< 1 > λ₂ = λ₃ > |λ₄|, with multiplicities: 1 once, λ₂ twice
  std::string ordering_witness;
  RingProof ring;                         ///< of the characteristic map
  Verdict c1 = Verdict::undecided;        ///< limit surfaces of generic data are C¹ at the centre
};

/// Decides a row. ordering: from the isolated eigenvalues alone, so that `refuted` names an exact multiplicity. ring:
/// see `prove_ring`; refuted when λ₂ belongs to mode m with 1 < m < k/2, whose ring winds m times. c1 (Reif 1995):
/// proved when ordering and ring are; refuted when the ordering is proved and the ring refuted.
[[nodiscard]] SpectrumRow spectrum_row(const SpectrumSubject& subject);

/// The ordering alone, from the spectra of the modes 0 … k/2; sets `subdominant` and `next` too.
void decide_ordering(SpectrumRow& row);

/// Rows in parallel; the result does not depend on the number of threads. Throws Cancelled between rows.
[[nodiscard]] std::vector<SpectrumRow> spectrum_rows(const std::vector<SpectrumSubject>& subjects, const ProgressPart& progress = {});

/// refuted if any part of the row is, else undecided if any is, else proved.
[[nodiscard]] Verdict overall(const SpectrumRow& row) noexcept;

/// Decimal numbers with at most `digits` digits behind the point that enclose the interval; both are the same number
/// when the interval is one number with so many digits.
struct DecimalEnclosure {
  std::string lo, hi;
};
[[nodiscard]] DecimalEnclosure decimal_enclosure(const RationalInterval& interval, int digits);

}  // namespace hexact
