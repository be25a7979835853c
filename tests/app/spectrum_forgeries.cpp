// SPDX-License-Identifier: GPL-3.0-or-later
// Proofs that look complete and prove something else: both checkers must see it, and the program must not write them.
#include "spectrum_samples.hpp"

#include "hexact/exact/regular_smoothness.hpp"

#include <catch2/catch.hpp>

using namespace hexact;
using namespace hexact::spectrum_test;

namespace {

SpectrumRow row_of(const MasksDocument& masks) { return spectrum_row(mask_subject(masks, masks.masks[0])); }

/// Squares of diagonal blocks: `diagonals` are those of the modes 0, 1 and 2.
MasksDocument diagonal_square(const std::vector<std::vector<Rational>>& diagonals) {
  const std::size_t n = diagonals[0].size();
  ExtraordinaryMask mask{4, {}, std::vector<std::vector<Rational>>(4, std::vector<Rational>(n * n))};
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t d = 0; d < 4; ++d) {
      const Rational two = Rational(d == 0 ? 2 : d == 2 ? -2 : 0), sign = Rational(d % 2 == 0 ? 1 : -1);
      mask.blocks[d][i * n + i] = (diagonals[0][i] + two * diagonals[1][i] + sign * diagonals[2][i]) / Rational(4);
    }
  }
  return {"test", std::nullopt, {std::move(mask)}};
}

Eigenvalue number(int mode, const Rational& x, int multiplicity) { return {mode, {x, x}, multiplicity}; }
Eigenvalue around_half(int mode, int multiplicity) {
  const Rational half = fraction(1, 2), width = Rational(1).scaled(-110);
  return {mode, {half - width, half + width}, multiplicity};
}
ModeSpectrum mode_of(std::vector<Eigenvalue> eigenvalues) {
  ModeSpectrum m;
  m.isolated = std::move(eigenvalues);
  return m;
}

}  // namespace

TEST_CASE("without constants there is no statement about limit surfaces", "[spectrum][certificate]") {
  const Checkers checkers;
  // The eigenvalue 1 is that of the sign that alternates around the k-gon; that of constants is 1/4.
  const MasksDocument alternating = weights(SpectrumScheme::doo_sabin, 4, {fraction(9, 16), fraction(-3, 16), fraction(1, 16), fraction(-3, 16)});
  const SpectrumRow row = row_of(alternating);
  CHECK(row.ordering == Verdict::proved);
  CHECK(row.ring.verdict == Verdict::undecided);
  CHECK(row.c1 == Verdict::undecided);
  const std::string text = text_of_masks(alternating);
  CHECK(checkers.of(text).claims == all_proved({"ordering=4"}));
  for (const std::string claim : {"ring=4", "c1=4", "ring-fails=4", "c1-fails=4"}) CHECK(checkers.of(with_claim(text, claim)).status == 1);
  for (const SpectrumScheme scheme : {SpectrumScheme::midedge, SpectrumScheme::midedge6, SpectrumScheme::loop, SpectrumScheme::catmull_clark, SpectrumScheme::doo_sabin}) {
    for (const int k : {3, 4, 5, 8}) CHECK(reproduces_constants(scheme_subject(scheme, k).matrix));
  }
}

TEST_CASE("two eigenvalues in one interval are not one of multiplicity 2", "[spectrum][certificate]") {
  const Checkers checkers;
  const Rational half = fraction(1, 2), near = half + Rational(1).scaled(-120), zero;
  const std::vector<Rational> zeros(3);
  SpectrumRow row;
  row.valence = 4;
  const auto all_zero = [](int mode) { return mode_of({number(mode, Rational(0), 3)}); };
  row.modes = {mode_of({number(0, Rational(1), 1), around_half(0, 2)}), all_zero(1), all_zero(2)};
  const Outcome pair = checkers.of(both_orderings(diagonal_square({{Rational(1), half, near}, zeros, zeros}), row));
  CHECK(pair.claims.at("ordering=4") == "refuted");
  CHECK(pair.claims.at("ordering-fails=4") == "refuted");
  row.modes = {mode_of({number(0, Rational(1), 1), number(0, Rational(0), 2)}), mode_of({around_half(1, 2), number(1, Rational(0), 1)}), all_zero(2)};
  const Outcome four = checkers.of(both_orderings(diagonal_square({{Rational(1), zero, zero}, {zero, half, near}, zeros}), row));
  CHECK(four.claims.at("ordering=4") == "refuted");
  CHECK(four.claims.at("ordering-fails=4") == "refuted");
  // The same numbers told apart are a proof.
  row.modes[1] = mode_of({number(1, near, 1), number(1, half, 1), number(1, Rational(0), 1)});
  CHECK(checkers.of(both_orderings(diagonal_square({{Rational(1), zero, zero}, {zero, half, near}, zeros}), row)).claims.at("ordering=4") == "proved");
}

TEST_CASE("the third eigenvalue is named only where it is certain", "[spectrum]") {
  // Two complex eigenvalues of mode 0 are greater than the one that could be isolated.
  const SpectrumRow row = row_of(weights(SpectrumScheme::catmull_clark, 5, {fraction(-3, 5), fraction(-6, 25), fraction(14, 25)}));
  REQUIRE(row.ordering == Verdict::proved);
  CHECK_FALSE(row.next);
  CHECK(spectrum_row(scheme_subject(SpectrumScheme::catmull_clark, 5)).next);
}

TEST_CASE("nothing is said of the ring of blocks", "[spectrum]") {
  const MasksDocument known = twice_around();
  MasksDocument blocks{"test", std::nullopt, {{5, {}, {}}}};
  for (const Rational& w : known.masks[0].weights) blocks.masks[0].blocks.push_back({w});
  CHECK(row_of(known).ring.verdict == Verdict::refuted);
  const SpectrumRow row = row_of(blocks);
  CHECK(row.ordering == Verdict::proved);
  CHECK(row.ring.verdict == Verdict::undecided);
  CHECK(row.c1 == Verdict::undecided);
}

TEST_CASE("bounds of rings are multiples of 10^-6 for both checkers", "[spectrum][certificate]") {
  const Checkers checkers;
  for (const SpectrumScheme scheme : {SpectrumScheme::midedge6, SpectrumScheme::loop}) {
    SpectrumCertificate certificate = make_spectrum_certificate(scheme, {spectrum_row(scheme_subject(scheme, 5))}, {"test"});
    CHECK(checkers.of(io::spectrum_certificate_text(certificate)).status == 0);
    certificate.rows[0].ring->jacobian -= fraction(1, 1000000);
    CHECK(checkers.of(io::spectrum_certificate_text(certificate)).status == 0);
    certificate.rows[0].ring->jacobian -= fraction(1, 100000000);
    CHECK(checkers.of(io::spectrum_certificate_text(certificate)).status == 1);
  }
}

TEST_CASE("masks say nothing of regular regions", "[spectrum][certificate]") {
  const Checkers checkers;
  const MasksDocument masks = weights(SpectrumScheme::loop, 6, {fraction(5, 8), fraction(1, 16)});
  SpectrumCertificate certificate = make_spectrum_certificate(masks, {row_of(masks)}, {"test"});
  certificate.regular = regular_smoothness(SpectrumScheme::loop).evidence;
  certificate.claims.push_back({SpectrumClaimKind::regular, 0});
  const Outcome outcome = checkers.of(io::spectrum_certificate_text(certificate));
  CHECK(outcome.claims.at("regular") == "refuted");
  CHECK(outcome.claims.at("c1=6") == "proved");
}
