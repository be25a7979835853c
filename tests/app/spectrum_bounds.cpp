// SPDX-License-Identifier: GPL-3.0-or-later
// Spectral certificates with very long, very small and very many numbers: both checkers answer alike, and soon.
#include "spectrum_samples.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>

using namespace hexact;
using namespace hexact::spectrum_test;

namespace {

/// A certificate of Loop's rule whose cosine interval is wider by 2^-bits at its lower end.
std::string with_cosine_bits(int k, long bits) {
  SpectrumCertificate certificate = make_spectrum_certificate(SpectrumScheme::loop, {spectrum_row(scheme_subject(SpectrumScheme::loop, k))}, {});
  certificate.rows[0].cosine.lo -= Rational(1).scaled(-bits);
  return io::spectrum_certificate_text(certificate);
}

/// A part of mode eigenvalues 1, 1/2, … beside n rows of weights about 2^-bits, which have complex eigenvalues of that size.
MasksDocument tiny_part(int k, std::size_t n, long bits, Dice& dice) {
  const std::size_t side = n + 1, valence = static_cast<std::size_t>(k);
  ExtraordinaryMask mask{k, {}, std::vector<std::vector<Rational>>(valence, std::vector<Rational>(side * side))};
  mask.blocks[0][0] = fraction(1, 2);
  mask.blocks[1][0] = mask.blocks[valence - 1][0] = fraction(1, 4);
  for (std::size_t r = 1; r < side; ++r) {
    for (std::size_t c = 1; c < side; ++c) {
      for (std::size_t d = 0; 2 * d <= valence; ++d) {
        const Rational w = Rational(static_cast<long>(dice.below(11)) - 5).scaled(-bits);
        mask.blocks[d][r * side + c] = mask.blocks[(valence - d) % valence][r * side + c] = w;
      }
    }
  }
  return {"test", std::nullopt, {std::move(mask)}};
}

}  // namespace

TEST_CASE("ends of cosines have 1024 bits at most", "[spectrum][certificate]") {
  const Checkers checkers;
  for (const int k : {5, 7, 30}) {
    CHECK(checkers.of(with_cosine_bits(k, 1000)).status == 0);
    CHECK(checkers.of(with_cosine_bits(k, 1023)).status == 0);
    CHECK(checkers.of(with_cosine_bits(k, 1024)).status == 1);
    CHECK(checkers.of(with_cosine_bits(k, 40000)).status == 1);
  }
}

TEST_CASE("discs around very small eigenvalues are proved by both checkers", "[spectrum][certificate]") {
  const Checkers checkers;
  constexpr std::uint64_t kSeed = 5;
  Dice dice(kSeed);
  int discs = 0;
  for (const auto& [n, bits] : {std::pair<std::size_t, long>{4, 55}, {6, 40}, {3, 70}, {2, 80}}) {
    for (int i = 0; i < 3; ++i) {
      const std::string text = text_of_masks(tiny_part(5, n, bits, dice));
      INFO("seed " << kSeed << ", " << n << " rows, 2^-" << bits << "\n" << text);
      CHECK(checkers.of(text).claims == all_proved({"ordering=5"}));
      if (text.find("\ndisc ") != std::string::npos) ++discs;
    }
  }
  CHECK(discs > 6);
}

TEST_CASE("a dense mask of a face with many corners", "[spectrum][certificate][masks]") {
  // w_d = (1/2 + cos(2πd/k))²/(3k/4) to 20 bits, and the rest at distance 0: every weight counts in every mode.
  const Checkers checkers;
  constexpr int kCorners = 120;
  std::vector<Rational> w(kCorners);
  Rational sum;
  for (int d = 1; d < kCorners; ++d) {
    const double x = 0.5 + std::cos(2 * M_PI * std::min(d, kCorners - d) / kCorners);
    w[static_cast<std::size_t>(d)] = Rational(std::lround(x * x / (0.75 * kCorners) * (1 << 20))).scaled(-20);
    sum += w[static_cast<std::size_t>(d)];
  }
  w[0] = Rational(1) - sum;
  const std::string text = text_of_masks(weights(SpectrumScheme::doo_sabin, kCorners, w));
  CHECK(checkers.of(text).claims.at("ordering=120") == "proved");
}

TEST_CASE("matrices whose polynomials would take minutes are refused by both checkers before the work", "[spectrum][certificate][masks]") {
  const Checkers checkers;
  Dice dice(3);
  const auto status = [&](int k, std::size_t n, const Rational& factor) {
    MasksDocument masks = random_blocks(k, n, dice);
    for (auto& block : masks.masks[0].blocks) {
      for (Rational& w : block) w *= factor;
    }
    SpectrumRow row;  // all that is said of each mode is that its eigenvalues are small
    row.valence = k;
    for (int m = 0; 2 * m <= k; ++m) row.modes.push_back({{}, static_cast<int>(n), Rational(1000)});
    return checkers.of(both_orderings(masks, row)).status;
  };
  CHECK(status(3, 6, Rational(1)) == 1);
  CHECK(status(9, 4, Rational(1)) == 1);
  CHECK(status(7, 48, Rational(1)) == 4);
  CHECK(status(30, 16, Rational(1)) == 4);
  CHECK(status(3, 10, Rational(1) / (Rational(1).scaled(60000) + Rational(1))) == 4);  // long weights
  CHECK(status(900, 4, Rational(1)) == 4);
}
