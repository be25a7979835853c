// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dice.hpp"
#include "spectrum_edits.hpp"

#include <set>
#include <string>
#include <vector>

// Masks with known or random spectra, their certificates, and what both checkers say of them.
namespace hexact::spectrum_test {

inline Rational fraction(long p, long q) { return Rational(p) / Rational(q); }

inline std::string text_of_scheme(SpectrumScheme scheme, const std::vector<int>& valences) {
  std::vector<SpectrumSubject> subjects;
  for (const int k : valences) subjects.push_back(scheme_subject(scheme, k));
  return io::spectrum_certificate_text(make_spectrum_certificate(scheme, spectrum_rows(subjects), {"test"}));
}

inline std::string text_of_masks(const MasksDocument& masks) {
  std::vector<SpectrumSubject> subjects;
  for (const ExtraordinaryMask& mask : masks.masks) subjects.push_back(mask_subject(masks, mask));
  return io::spectrum_certificate_text(make_spectrum_certificate(masks, spectrum_rows(subjects), {"test"}));
}

inline MasksDocument weights(SpectrumScheme scheme, int k, std::vector<Rational> w) { return {"test", scheme, {{k, std::move(w), {}}}}; }

/// A pentagon whose second eigenvalue is of mode 2.
inline MasksDocument twice_around() { return weights(SpectrumScheme::doo_sabin, 5, {fraction(2, 5), fraction(1, 20), fraction(1, 4), fraction(1, 4), fraction(1, 20)}); }
/// Catmull and Clark's rule with a centre whose mode 0 has two complex eigenvalues.
inline MasksDocument complex_centre(int k) { return weights(SpectrumScheme::catmull_clark, k, {fraction(1, 2), Rational(-1) / Rational(k), fraction(3, 2 * k)}); }

/// Blocks of random weights, mirror images of each other, with rows of sum 1.
inline MasksDocument random_blocks(int k, std::size_t n, Dice& dice) {
  ExtraordinaryMask mask{k, {}, std::vector<std::vector<Rational>>(static_cast<std::size_t>(k), std::vector<Rational>(n * n))};
  for (std::size_t i = 0; i < n * n; ++i) {
    for (int d = 0; 2 * d <= k; ++d) {
      const Rational w = Rational(static_cast<long>(dice.below(9)) - 4) / Rational(static_cast<long>(32 * n));
      mask.blocks[static_cast<std::size_t>(d)][i] = mask.blocks[static_cast<std::size_t>((k - d) % k)][i] = w;
    }
  }
  for (std::size_t r = 0; r < n; ++r) {
    Rational sum;
    for (const auto& block : mask.blocks) {
      for (std::size_t c = 0; c < n; ++c) sum += block[r * n + c];
    }
    for (auto& block : mask.blocks) block[r * n] += (Rational(1) - sum) / Rational(k);
  }
  return {"test", std::nullopt, {std::move(mask)}};
}

inline std::map<std::string, std::string> all_proved(const std::vector<std::string>& claims) {
  std::map<std::string, std::string> out;
  for (const std::string& c : claims) out[c] = "proved";
  return out;
}

/// Both claims about the ordering of masks, true or not, with all that is known of the eigenvalues.
inline std::string both_orderings(const MasksDocument& masks, const SpectrumRow& row) {
  const int k = row.valence;
  const SpectrumCertificate loop = make_spectrum_certificate(SpectrumScheme::loop, {spectrum_row(scheme_subject(SpectrumScheme::loop, k))}, {});
  SpectrumCertificate certificate;
  certificate.scheme = masks.scheme;
  certificate.claims = {{SpectrumClaimKind::ordering, k}, {SpectrumClaimKind::ordering_fails, k}};
  certificate.rows.push_back({k, masks.masks[0], loop.rows[0].cosine, row.modes, std::nullopt});
  return io::spectrum_certificate_text(certificate);
}

/// Triangles or squares of blocks with chosen eigenvalues: on the diagonal numbers or companion matrices of X² − pX + q,
/// of one sum in mode 0 and another in mode 1 (and, for squares, a third in mode 2).
inline MasksDocument chosen_eigenvalues(int k, Dice& dice) {
  const std::vector<Rational> numbers{Rational(1), Rational(1), Rational(-1), fraction(1, 2), fraction(1, 2), fraction(1, 2), fraction(-1, 2), fraction(1, 4), Rational(0), fraction(3, 2)};
  const auto draw = [&] { return numbers[dice.below(numbers.size())]; };
  const std::size_t n = 1 + dice.below(4);
  std::vector<std::vector<Rational>> modes(static_cast<std::size_t>(k / 2) + 1, std::vector<Rational>(n * n));
  for (std::size_t m = 0; m < modes.size(); ++m) {
    for (std::size_t i = 0; i < n; ++i) {
      if (i + 1 < n && dice.below(3) == 0) {
        modes[m][i * n + i + 1] = Rational(-1) / Rational(static_cast<long>(3 + dice.below(3)));  // −q, and p below
        if (dice.below(2) == 0) modes[m][i * n + i + 1] = -modes[m][i * n + i + 1];
        modes[m][(i + 1) * n + i] = Rational(1);
        modes[m][(i + 1) * n + i + 1] = dice.below(2) == 0 ? Rational(0) : fraction(1, 8);
        ++i;
      } else {
        modes[m][i * n + i] = m == 0 && i == 0 && dice.below(4) > 0 ? Rational(1) : m > 0 && i == 0 ? fraction(1, 2) : draw();
      }
    }
  }
  // The inverse of M_m = Σ D_d cos(2πmd/k).
  ExtraordinaryMask mask{k, {}, std::vector<std::vector<Rational>>(static_cast<std::size_t>(k), std::vector<Rational>(n * n))};
  for (std::size_t i = 0; i < n * n; ++i) {
    for (std::size_t d = 0; d < static_cast<std::size_t>(k); ++d) {
      Rational sum = modes[0][i];
      if (k == 3) sum += modes[1][i] * (d == 0 ? Rational(2) : Rational(-1));
      else sum += modes[1][i] * Rational(d == 0 ? 2 : d == 2 ? -2 : 0) + modes[2][i] * Rational(d % 2 == 0 ? 1 : -1);
      mask.blocks[d][i] = sum / Rational(k);
    }
  }
  return {"test", std::nullopt, {std::move(mask)}};
}

class Checkers {
 public:
  /// What both say.
  Outcome of(const std::string& text) const {
    const Outcome library = by_library(text), checker = by_checker(folder_, text);
    CHECK(library.status == checker.status);
    CHECK(library.claims == checker.claims);
    return library;
  }

 private:
  program::Folder folder_;
};

/// `claim` in addition to those of the certificate.
inline std::string with_claim(const std::string& text, const std::string& claim) {
  const std::size_t at = text.find("claims ") + 7, end = text.find('\n', at);
  const int n = std::stoi(text.substr(at, end - at));
  return with_digest(text.substr(0, at) + std::to_string(n + 1) + "\nclaim " + claim + text.substr(end));
}

/// As it was written before claims were named.
inline std::string without_claims(std::string text) {
  const std::size_t at = text.find("claims ");
  return with_digest(text.erase(at, text.find("rows ") - at));
}

/// Every claim that an edited certificate proves is true of the matrix that it is then about.
inline void check_truth(const std::string& text, const Outcome& outcome) {
  if (outcome.status == 3) return;
  const SpectrumCertificate certificate = io::parse_spectrum_certificate(text, "test");
  for (const auto& row : certificate.rows) {
    const bool proves = std::any_of(outcome.claims.begin(), outcome.claims.end(), [&](const auto& c) {
      return c.second == "proved" && spectrum_claim(c.first)->valence == row.valence;
    });
    if (!proves) continue;
    const SpectrumSubject subject = row.mask ? mask_subject({"", certificate.scheme, {}}, *row.mask) : scheme_subject(*certificate.scheme, row.valence);
    std::set<std::string> truth;
    for (const SpectrumClaim& c : proved_claims(spectrum_row(subject))) truth.insert(text_of(c));
    for (const auto& [claim, verdict] : outcome.claims) {
      if (verdict == "proved" && spectrum_claim(claim)->valence == row.valence) CHECK(truth.count(claim) == 1);
    }
  }
}

}  // namespace hexact::spectrum_test
