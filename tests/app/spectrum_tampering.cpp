// SPDX-License-Identifier: GPL-3.0-or-later
// Spectral certificates under edits: hexact-check and the library agree on each, and no false claim passes.
#include "spectrum_samples.hpp"

#include <catch2/catch.hpp>

#include <cctype>
#include <cstdint>
#include <sstream>

using namespace hexact;
using namespace hexact::spectrum_test;

TEST_CASE("both checkers decide orderings alike: proved, refuted and open", "[spectrum][certificate]") {
  const Checkers checkers;
  constexpr std::uint64_t kSeed = 3;
  Dice dice(kSeed);
  std::map<Verdict, int> count;
  for (int i = 0; i < 240; ++i) {
    const MasksDocument masks = chosen_eigenvalues(i % 2 == 0 ? 3 : 4, dice);
    const SpectrumRow row = spectrum_row(mask_subject(masks, masks.masks[0]));
    const std::string text = both_orderings(masks, row), k = std::to_string(row.valence);
    INFO("seed " << kSeed << ", sample " << i << "\n" << text);
    const Outcome outcome = checkers.of(text);
    CHECK(outcome.claims.at("ordering=" + k) == (row.ordering == Verdict::proved ? "proved" : "refuted"));
    CHECK(outcome.claims.at("ordering-fails=" + k) == (row.ordering == Verdict::refuted ? "proved" : "refuted"));
    ++count[row.ordering];
  }
  CHECK(count[Verdict::proved] > 20);
  CHECK(count[Verdict::refuted] > 60);
  CHECK(count[Verdict::undecided] > 4);
}

TEST_CASE("every number changed, every line taken away or moved: the checkers agree", "[spectrum][certificate]") {
  const Checkers checkers;
  Dice samples(6);
  for (const std::string& text : {text_of_masks(random_blocks(3, 2, samples)), text_of_masks(twice_around()), text_of_scheme(SpectrumScheme::loop, {3})}) {
    REQUIRE(checkers.of(text).status == 0);
    std::vector<std::string> lines;
    std::istringstream in(text);
    for (std::string line; std::getline(in, line);) lines.push_back(line + "\n");
    const auto joined = [&](const std::vector<std::string>& all) {
      std::string out;
      for (const std::string& l : all) out += l;
      return with_digest(out);
    };
    for (std::size_t i = 2; i + 1 < lines.size(); ++i) {  // not the first line, the comment and the digest
      std::vector<std::string> fewer = lines, swapped = lines;
      fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
      std::swap(swapped[i], swapped[i + 1 == lines.size() - 1 ? 2 : i + 1]);
      CHECK(checkers.of(joined(fewer)).status != 0);
      check_truth(joined(swapped), checkers.of(joined(swapped)));
      for (std::size_t at = 0; at < lines[i].size(); ++at) {  // the last digit of each number
        const auto digit = [&](std::size_t p) { return p < lines[i].size() && std::isdigit(static_cast<unsigned char>(lines[i][p])) != 0; };
        if (!digit(at) || digit(at + 1)) continue;
        std::vector<std::string> changed = lines;
        changed[i][at] = changed[i][at] == '9' ? '8' : static_cast<char>(changed[i][at] + 1);
        INFO("line " << i << ": " << changed[i]);
        const Outcome outcome = checkers.of(joined(changed));
        check_truth(joined(changed), outcome);
        const bool slack = lines[i].substr(0, 4) == "ring" || lines[i].find('/') != std::string::npos;  // a wider interval, a weaker bound
        if (!slack) CHECK(outcome.status != 0);
      }
    }
  }
}

TEST_CASE("the certificate of one mask is none of another", "[spectrum][certificate][masks]") {
  const Checkers checkers;
  const auto mask_lines = [](const std::string& text) {
    const std::size_t first = text.find('\n', text.find("\nrow ") + 1) + 1;
    return text.substr(first, text.find("cosine ") - first);
  };
  const std::vector<MasksDocument> of_loop{weights(SpectrumScheme::loop, 5, {fraction(1, 2), fraction(1, 10)}),
                                           weights(SpectrumScheme::loop, 5, {fraction(2, 5), fraction(3, 25)})},
      of_face{weights(SpectrumScheme::doo_sabin, 5, {fraction(2, 5), fraction(1, 5), fraction(1, 10), fraction(1, 10), fraction(1, 5)}), twice_around()};
  Dice dice(5);
  const std::vector<MasksDocument> of_blocks{random_blocks(3, 2, dice), random_blocks(3, 2, dice)};
  for (const auto& pair : {of_loop, of_face, of_blocks}) {
    const std::string one = text_of_masks(pair[0]), other = text_of_masks(pair[1]);
    REQUIRE(mask_lines(one) != mask_lines(other));
    for (const auto& [text, stranger] : {std::pair{one, other}, {other, one}}) {
      CHECK(checkers.of(text).status == 0);
      for (const auto& [claim, verdict] : checkers.of(replaced(text, mask_lines(text), mask_lines(stranger))).claims) CHECK(verdict == "refuted");
      // Without its mask the row is about the scheme itself, or about nothing.
      CHECK(checkers.of(replaced(text, mask_lines(text), "")).status == 1);
    }
  }
  // Masks that are none: of another scheme, of the wrong length, without mirror image.
  const std::string face = text_of_masks(of_face[0]);
  CHECK(checkers.of(replaced(face, "scheme doo-sabin", "scheme loop")).status == 1);
  CHECK(checkers.of(replaced(face, "scheme doo-sabin", "scheme midedge")).status == 1);
  CHECK(checkers.of(replaced(face, "scheme doo-sabin", "scheme blocks")).status == 3);
  CHECK(checkers.of(replaced(face, "weights 5 2/5 1/5 1/10 1/10 1/5", "weights 4 2/5 1/5 1/10 1/10")).status == 1);
  CHECK(checkers.of(replaced(face, "weights 5 2/5 1/5 1/10 1/10 1/5", "weights 5 2/5 3/10 1/10 1/10 1/10")).status == 1);
  const std::string loop = text_of_masks(of_loop[0]);
  CHECK(checkers.of(replaced(loop, "weights 2 1/2 1/10", "weights 3 1/2 1/10 1/7")).status == 1);
}

TEST_CASE("weights without mirror image are refused although a polynomial in the cosine fits them", "[spectrum][certificate][masks]") {
  // a + bz + c/z at z = 2 and 3 lies on a line over (z + 1/z)/2, which has a − 11b/5 + 6c/5 at −1/2.
  const Checkers checkers;
  const std::string face = text_of_masks(weights(SpectrumScheme::doo_sabin, 3, {fraction(5, 8), fraction(3, 16), fraction(3, 16)}));
  REQUIRE(checkers.of(face).claims.at("ordering=3") == "proved");
  CHECK(face.find("\n7/16 7/16 1\n") != std::string::npos);
  CHECK(checkers.of(replaced(face, "weights 3 5/8 3/16 3/16", "weights 3 57/64 11/64 -1/16")).claims.at("ordering=3") == "refuted");
  const std::string blocks = text_of_masks(MasksDocument{"test", std::nullopt, {{3, {}, {{fraction(5, 8)}, {fraction(3, 16)}, {fraction(3, 16)}}}}});
  REQUIRE(checkers.of(blocks).claims.at("ordering=3") == "proved");
  CHECK(checkers.of(replaced(blocks, "\n5/8\n3/16\n3/16\n", "\n57/64\n11/64\n-1/16\n")).claims.at("ordering=3") == "refuted");
}

TEST_CASE("of blocks nothing is claimed but the ordering", "[spectrum][certificate][masks]") {
  const Checkers checkers;
  const MasksDocument winding{"test", std::nullopt, {{5, {}, {{fraction(2, 5)}, {fraction(1, 20)}, {fraction(1, 4)}, {fraction(1, 4)}, {fraction(1, 20)}}}}};
  const MasksDocument plain{"test", std::nullopt, {{5, {}, {{fraction(2, 5)}, {fraction(1, 4)}, {fraction(1, 20)}, {fraction(1, 20)}, {fraction(1, 4)}}}}};
  for (const MasksDocument& masks : {winding, plain}) {
    const std::string text = text_of_masks(masks);
    REQUIRE(checkers.of(text).claims == all_proved({"ordering=5"}));
    for (const char* claim : {"ring=5", "c1=5", "ring-fails=5", "c1-fails=5"}) CHECK(checkers.of(with_claim(text, claim)).claims.at(claim) == "refuted");
  }
}

TEST_CASE("edited certificates of masks and of what fails: the checkers agree, and no false claim passes", "[spectrum][certificate]") {
  const Checkers checkers;
  Dice samples(11);
  const std::vector<std::string> originals{text_of_scheme(SpectrumScheme::midedge, {3, 4}), text_of_masks(twice_around()), text_of_masks(complex_centre(5)),
                                           text_of_masks(complex_centre(6)), text_of_masks(random_blocks(5, 3, samples)),
                                           text_of_masks(random_blocks(4, 2, samples)),
                                           text_of_masks(weights(SpectrumScheme::loop, 7, {fraction(1, 2), fraction(1, 14)}))};
  constexpr std::uint64_t kSeed = 20261126;
  Dice dice(kSeed);
  int malformed = 0, refuted = 0, proved = 0;
  for (int i = 0; i < 700; ++i) {
    std::string text = edited(originals[static_cast<std::size_t>(i) % originals.size()], dice);
    if (dice.below(3) == 0) text = edited(text, dice);
    INFO("seed " << kSeed << ", edit " << i << ":\n" << text);
    const Outcome outcome = checkers.of(text);
    check_truth(text, outcome);
    ++(outcome.status == 3 ? malformed : outcome.status == 1 ? refuted : proved);
  }
  INFO(malformed << " malformed, " << refuted << " refuted, " << proved << " still proved");
  CHECK(malformed > 100);
  CHECK(refuted > 200);
  CHECK(proved > 10);
}
