// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace hexact {

/// The outcome of an attempt to prove something. A failed attempt is `undecided`, never a guess.
enum class Verdict { proved, refuted, undecided };

/// "proved", "refuted" or "undecided".
[[nodiscard]] constexpr const char* name_of(Verdict v) noexcept {
  return v == Verdict::proved ? "proved" : v == Verdict::refuted ? "refuted" : "undecided";
}

/// The outcome for one claim; `witness` names element and exact quantity when it is refuted,
/// and the reason when it is undecided.
struct ClaimVerdict {
  std::string claim;
  Verdict verdict = Verdict::undecided;
  std::string witness;
};

}  // namespace hexact
