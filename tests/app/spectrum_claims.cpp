// SPDX-License-Identifier: GPL-3.0-or-later
// The claims of spectral certificates: what is refuted, what is undecided in part, masks, eigenvalues in a disc.
#include "spectrum_samples.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

using namespace hexact;
using namespace hexact::spectrum_test;

TEST_CASE("claims have one spelling", "[spectrum][certificate]") {
  for (const char* text : {"ordering=3", "ring=50", "c1=1000", "ordering-fails=7", "ring-fails=8", "c1-fails=9"}) {
    REQUIRE(spectrum_claim(text));
    CHECK(text_of(*spectrum_claim(text)) == text);
  }
  for (const char* text : {"", "ordering", "ordering=", "=3", "ordering=03", "ordering=+3", "ordering=3 ", "ordering=99999999999", "order=3", "c1=3=4", "c1=3x"}) {
    CHECK_FALSE(spectrum_claim(text));
  }
}

TEST_CASE("what is refuted is certified as such, and both checkers prove it", "[spectrum][certificate]") {
  const Checkers checkers;
  const std::string eightfold = text_of_scheme(SpectrumScheme::midedge, {3, 4});
  CHECK(checkers.of(eightfold).claims == all_proved({"ordering-fails=3", "ordering=4", "ring=4", "c1=4"}));
  CHECK(eightfold.find("\nring ") == eightfold.rfind("\nring "));  // no ring of the first row
  const std::string winding = text_of_masks(twice_around());
  CHECK(checkers.of(winding).claims == all_proved({"ordering=5", "ring-fails=5", "c1-fails=5"}));
  // Sums of the weights that are not 1: 1 is no eigenvalue; a heavy centre: the second eigenvalue is simple; all weight
  // stays at the corners: 1 is multiple; the alternating sign of a square: 1/2 and -1/2; all weight turns: modulus 1.
  for (const MasksDocument& masks :
       {weights(SpectrumScheme::loop, 5, {fraction(1, 2), fraction(1, 11)}), weights(SpectrumScheme::loop, 5, {fraction(19, 20), fraction(1, 100)}),
        weights(SpectrumScheme::doo_sabin, 5, {Rational(1), Rational(0), Rational(0), Rational(0), Rational(0)}),
        weights(SpectrumScheme::doo_sabin, 4, {fraction(1, 4), fraction(1, 2), fraction(-1, 4), fraction(1, 2)}),
        MasksDocument{"test", std::nullopt, {{3, {}, {{Rational(1)}, {Rational(0)}, {Rational(0)}}}}}}) {
    const int k = masks.masks[0].valence;
    const Outcome outcome = checkers.of(text_of_masks(masks));
    CHECK(outcome.status == 0);
    CHECK(outcome.claims == all_proved({"ordering-fails=" + std::to_string(k)}));
  }
}

TEST_CASE("no statement passes that the numbers contradict, nor one that they leave open", "[spectrum][certificate]") {
  const Checkers checkers;
  const std::vector<std::string> statements{"ordering", "ring", "c1", "ordering-fails", "ring-fails", "c1-fails"};
  const std::string eightfold = text_of_scheme(SpectrumScheme::midedge, {3}), good = text_of_scheme(SpectrumScheme::loop, {3}),
                    winding = text_of_masks(twice_around()), bounded = text_of_masks(complex_centre(5));
  for (const std::string& text : {eightfold, good, winding, bounded}) {
    const std::map<std::string, std::string> true_claims = checkers.of(text).claims;
    for (const std::string& s : statements) {
      const std::string claim = s + "=" + text.substr(text.find("\nrow ") + 5, 1);
      if (true_claims.count(claim) != 0) {
        CHECK(checkers.of(with_claim(text, claim)).status == 3);  // twice
        continue;
      }
      const Outcome outcome = checkers.of(with_claim(text, claim));
      CHECK(outcome.status == 1);
      CHECK(outcome.claims.at(claim) == "refuted");
      for (const auto& [other, verdict] : true_claims) CHECK(outcome.claims.at(other) == verdict);
    }
    CHECK(checkers.of(with_claim(text, "ordering=9")).status == 3);
    CHECK(checkers.of(with_claim(text, "closed")).status == 3);
  }
  // A ring is claimed, but its bounds are gone.
  const std::size_t ring = good.find("\nring ");
  CHECK(checkers.of(with_digest(good.substr(0, ring + 1) + good.substr(good.find('\n', ring + 1) + 1))).claims ==
        std::map<std::string, std::string>{{"ordering=3", "proved"}, {"ring=3", "refuted"}, {"c1=3", "refuted"}});
}

TEST_CASE("a certificate without claims proves nothing; one from before claims were named claims all three", "[spectrum][certificate]") {
  const Checkers checkers;
  const program::Folder folder;
  const std::string good = text_of_scheme(SpectrumScheme::loop, {3, 4}), eightfold = text_of_scheme(SpectrumScheme::midedge, {3});
  const std::string rows = good.substr(good.find("rows "));
  const std::string silent = with_digest("hexact-spectrum 1\nscheme loop\nclaims 0\n" + rows);
  CHECK(checkers.of(silent).status == 3);
  program::write_bytes(folder.path().string() + "/silent.cert", silent);
  CHECK(program::run(folder, "$hexact check silent.cert").status == 3);
  CHECK(checkers.of(without_claims(good)).claims == all_proved({"ordering=3", "ring=3", "c1=3", "ordering=4", "ring=4", "c1=4"}));
  CHECK(checkers.of(without_claims(eightfold)).claims ==
        std::map<std::string, std::string>{{"ordering=3", "refuted"}, {"ring=3", "refuted"}, {"c1=3", "refuted"}});
  // A file that was written by the first version of the format.
  const std::string old = program::read_bytes(HEXACT_TEST_DATA "/loop3_first_format.cert");
  CHECK(old.find("claim") == std::string::npos);
  CHECK(checkers.of(old).claims == all_proved({"ordering=3", "ring=3", "c1=3"}));
}

TEST_CASE("numbers with leading zeros are decimal", "[spectrum][certificate]") {
  const Checkers checkers;
  const std::string good = text_of_scheme(SpectrumScheme::loop, {3});
  CHECK(checkers.of(replaced(good, "ring 0 174999/1000000", "ring 0 017/0100")).status == 0);   // 15/64 would be too much
  CHECK(checkers.of(replaced(good, "ring 0 174999/1000000", "ring 0 0174999/01000000")).status == 0);
  CHECK(checkers.of(replaced(good, "ring 0 174999/1000000", "ring 0 0175/01000")).status == 1);
}

TEST_CASE("complex and clustered eigenvalues are certified by a disc", "[spectrum][certificate]") {
  const Checkers checkers;
  const std::string text = text_of_masks(complex_centre(5));
  const std::size_t at = text.find("\ndisc 2 ");
  REQUIRE(at != std::string::npos);
  CHECK(checkers.of(text).claims == all_proved({"ordering=5", "ring=5", "c1=5"}));
  const std::string line = text.substr(at + 1, text.find('\n', at + 1) - at - 1);
  // A smaller disc has no root; a greater one reaches the second eigenvalue, 0.5499883…; none at all leaves two out.
  for (const char* refuted : {"disc 2 3/10", "disc 2 11/20", "disc 2 2", "disc 2 0", "disc 2 -1/2", "disc 1 1/2", "disc 3 1/2"}) {
    CHECK(checkers.of(replaced(text, line, refuted)).status == 1);
  }
  CHECK(checkers.of(replaced(text, line, "disc 2 1/2")).status == 0);
  CHECK(checkers.of(replaced(text, line + "\n", "")).status == 1);
  CHECK(checkers.of(replaced(text, line, "disc 0 1/2")).status == 3);
  // Every kind of c: rational at 3, 4 and 6, in an interval at 5 and 7.
  constexpr std::uint64_t kSeed = 71;
  Dice dice(kSeed);
  int with_disc = 0, ordered = 0;
  for (const auto& [k, n] : std::vector<std::pair<int, std::size_t>>{{3, 2}, {4, 3}, {5, 2}, {5, 3}, {5, 6}, {6, 3}, {7, 4}}) {
    for (int i = 0; i < 8; ++i) {
      INFO("seed " << kSeed << ", valence " << k << ", " << n << " rows, sample " << i);
      const MasksDocument masks = random_blocks(k, n, dice);
      const Verdict ordering = spectrum_row(mask_subject(masks, masks.masks[0])).ordering;
      const std::string blocks = text_of_masks(masks);
      const Outcome outcome = checkers.of(blocks);
      if (ordering == Verdict::undecided) {
        CHECK(outcome.status == 3);
        continue;
      }
      CHECK(outcome.claims == all_proved({(ordering == Verdict::proved ? "ordering=" : "ordering-fails=") + std::to_string(k)}));
      with_disc += blocks.find("\ndisc ") != std::string::npos ? 1 : 0;
      ordered += ordering == Verdict::proved ? 1 : 0;
    }
  }
  CHECK(with_disc > 15);
  CHECK(ordered > 1);
}

TEST_CASE("an eigenvalue that two factors have is certified, although one of them knows only an interval", "[spectrum][certificate]") {
  // A decagon with λ = 3/8 ± √5/18 in modes 1 and 3, and 1/4 in modes 2 and 4, where cosines are irrational, and 5.
  const Rational a = fraction(3, 8), b = fraction(1, 18), quarter = fraction(1, 4);
  const std::vector<Rational> of_1_and_3{Rational(2) * a, (a + Rational(5) * b) / Rational(2), (Rational(5) * b - a) / Rational(2),
                                         (a - Rational(5) * b) / Rational(2), -(a + Rational(5) * b) / Rational(2), Rational(-2) * a};
  std::vector<Rational> w;
  for (std::size_t d = 0; d < 10; ++d) {
    const Rational of_2_and_4 = quarter * (d % 5 == 0 ? Rational(2) : fraction(-1, 2));
    w.push_back((Rational(1) + Rational(2) * (of_1_and_3[std::min(d, 10 - d)] + of_2_and_4) + (d % 2 == 0 ? quarter : -quarter)) / Rational(10));
  }
  const MasksDocument masks = weights(SpectrumScheme::doo_sabin, 10, w);
  const SpectrumRow row = spectrum_row(mask_subject(masks, masks.masks[0]));
  REQUIRE(overall(row) == Verdict::proved);
  CHECK(row.subdominant->enclosure.lo.to_double() == Approx(0.375 + std::sqrt(5.0) / 18));
  const Checkers checkers;
  const std::string text = text_of_masks(masks);
  CHECK(text.find("\ndisc 1 ") != std::string::npos);
  CHECK(checkers.of(text).claims == all_proved({"ordering=10", "ring=10", "c1=10"}));
}

TEST_CASE("spectrum writes certificates of masks and says what they state", "[spectrum][program][masks]") {
  const program::Folder folder;
  const auto write = [&](const std::string& rest) { program::write_bytes(folder.path().string() + "/m.json", R"({"hexact": "masks", "version": 1, )" + rest + "}"); };
  const auto run = [&](const std::string& arguments) { return program::run(folder, "$hexact spectrum --masks m.json " + arguments); };
  write(R"("scheme": "doo-sabin", "masks": [{"valence": 5, "weights": ["2/5", "1/20", "1/4", "1/4", "1/20"]}, {"valence": 4, "weights": ["9/16", "3/16", "1/16", "3/16"]}])");
  program::Run r = run("--json --certificate m.cert");
  CHECK(r.status == 1);
  const auto report = nlohmann::json::parse(r.out);
  CHECK(report["certificate"] == "m.cert");
  CHECK(report["claims"] == nlohmann::json::parse(R"(["ordering=5", "ring-fails=5", "c1-fails=5", "ordering=4", "ring=4", "c1=4"])"));
  CHECK(report["left_out"] == nlohmann::json::array());
  CHECK(program::run(folder, "$check m.cert && $hexact check m.cert").status == 0);
  CHECK(run("--certificate m.cert").out.find("states ordering=4,5 ring=4 c1=4 ring-fails=5 c1-fails=5\n") != std::string::npos);
  // Blocks whose second eigenvalue winds twice: nothing is said of their ring.
  write(R"("masks": [{"valence": 5, "blocks": [[["2/5"]], [["1/20"]], [["1/4"]], [["1/4"]], [["1/20"]]]}])");
  r = run("--json --certificate b.cert");
  CHECK(r.status == 5);
  CHECK(nlohmann::json::parse(r.out)["claims"] == nlohmann::json::array({"ordering=5"}));
  CHECK(nlohmann::json::parse(r.out)["left_out"] == nlohmann::json::array());
  CHECK(program::run(folder, "$check b.cert && $hexact check b.cert").status == 0);
  // Nothing is proved: modes 1 and 2 have the same second eigenvalue in intervals that overlap.
  write(R"("scheme": "doo-sabin", "masks": [{"valence": 7, "weights": ["1/2", "1/12", "1/12", "1/12", "1/12", "1/12", "1/12"]}])");
  r = run("--json --certificate n.cert");
  CHECK(r.status == 5);
  CHECK(nlohmann::json::parse(r.out)["certificate"].is_null());
  CHECK(program::run(folder, "test ! -e n.cert").status == 0);
}
