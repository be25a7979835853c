// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/exact/spectrum_claims.hpp"

#include <array>
#include <charconv>
#include <utility>

namespace hexact {
namespace {

constexpr std::array<std::pair<SpectrumClaimKind, std::string_view>, 6> kNames = {{
    {SpectrumClaimKind::ordering, "ordering"},
    {SpectrumClaimKind::ring, "ring"},
    {SpectrumClaimKind::c1, "c1"},
    {SpectrumClaimKind::ordering_fails, "ordering-fails"},
    {SpectrumClaimKind::ring_fails, "ring-fails"},
    {SpectrumClaimKind::c1_fails, "c1-fails"},
}};
constexpr std::string_view kRegular = "regular";

}  // namespace

std::string text_of(const SpectrumClaim& claim) {
  if (claim.kind == SpectrumClaimKind::regular) return std::string(kRegular);
  std::string text;
  for (const auto& [kind, name] : kNames) {
    if (kind == claim.kind) text = name;
  }
  return text + "=" + std::to_string(claim.valence);
}

std::optional<SpectrumClaim> spectrum_claim(std::string_view text) {
  if (text == kRegular) return SpectrumClaim{SpectrumClaimKind::regular, 0};
  const std::size_t equals = text.find('=');
  if (equals == std::string_view::npos) return std::nullopt;
  const std::string_view number = text.substr(equals + 1);
  for (const auto& [kind, name] : kNames) {
    if (name != text.substr(0, equals)) continue;
    SpectrumClaim claim{kind, 0};
    std::from_chars(number.data(), number.data() + number.size(), claim.valence);
    if (text_of(claim) == text) return claim;  // one spelling only
  }
  return std::nullopt;
}

std::vector<SpectrumClaim> proved_claims(const SpectrumRow& row) {
  std::vector<SpectrumClaim> out;
  const auto add = [&](Verdict v, SpectrumClaimKind holds, SpectrumClaimKind fails) {
    if (v != Verdict::undecided) out.push_back({v == Verdict::proved ? holds : fails, row.valence});
  };
  add(row.ordering, SpectrumClaimKind::ordering, SpectrumClaimKind::ordering_fails);
  add(row.ring.verdict, SpectrumClaimKind::ring, SpectrumClaimKind::ring_fails);
  add(row.c1, SpectrumClaimKind::c1, SpectrumClaimKind::c1_fails);
  return out;
}

}  // namespace hexact
