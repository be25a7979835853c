// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/io/spectrum_certificate_file.hpp"

#include "hexact/io/mesh_file.hpp"
#include "hexact/kernel/errors.hpp"
#include "line_scanner.hpp"
#include "regular_evidence_text.hpp"

#include <algorithm>
#include <array>
#include <fstream>

namespace hexact::io {
namespace {

constexpr std::string_view kKeyword = "hexact-spectrum";
constexpr std::string_view kBlocks = "blocks";  ///< in place of a scheme: the rows give their matrices
constexpr std::size_t kLargestFile = std::size_t{256} << 20;
constexpr std::int64_t kLargestValence = 1000;

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& name)
      : bytes_(bytes), scanner_(bytes, name, LineScanner::Comments::whole_lines) {}

  SpectrumCertificate read() {
    if (!scanner_.next_line() || scanner_.word() != kKeyword || scanner_.word() != "1") {
      scanner_.fail("expected the first line hexact-spectrum 1");
    }
    scanner_.expect_end();
    next_keyword();
    expect("scheme");
    out_.scheme = scheme(scanner_.expect_word("a scheme"));
    scanner_.expect_end();
    next_keyword();
    const bool names_claims = keyword_ == "claims";
    if (names_claims) claims();
    expect("rows");
    const std::size_t rows = scanner_.count("rows", 8, kLargestValence);
    scanner_.expect_end();
    next_keyword();
    for (std::size_t i = 0; i < rows; ++i) row({"row", i});
    if (keyword_ == "regular" && names_claims && out_.scheme) {
      out_.regular = read_regular_evidence(scanner_);
      next_keyword();
    }
    if (names_claims) check_claims();
    else imply_claims();
    expect("sha256");
    digest();
    out_.provenance = scanner_.comments();
    return std::move(out_);
  }

 private:
  /// Moves to the next line and reads its first word.
  void next_keyword(Element element = {}) {
    scanner_.expect_line("a keyword", element);
    keyword_ = scanner_.word();
  }
  void expect(std::string_view keyword, Element element = {}) const {
    if (keyword_ != keyword) scanner_.fail("expected " + std::string(keyword), element);
  }

  std::optional<SpectrumScheme> scheme(std::string_view name) const {
    if (name == kBlocks) return std::nullopt;
    for (const SpectrumScheme s : {SpectrumScheme::midedge, SpectrumScheme::midedge6, SpectrumScheme::loop,
                                   SpectrumScheme::catmull_clark, SpectrumScheme::doo_sabin}) {
      if (name == name_of(s)) return s;
    }
    scanner_.fail("there is no scheme " + quoted(name));
  }

  void claims() {
    const std::size_t n = scanner_.count("claims", 8, 6 * kLargestValence + 1);
    scanner_.expect_end();
    next_keyword();
    for (std::size_t i = 0; i < n; ++i) {
      const Element element{"claim", i};
      expect("claim", element);
      const std::string_view text = scanner_.expect_word("a claim", element);
      const auto claim = spectrum_claim(text);
      if (!claim) scanner_.fail("there is no claim " + quoted(text), element);
      if (std::find(out_.claims.begin(), out_.claims.end(), *claim) != out_.claims.end()) scanner_.fail("the claim stands here twice", element);
      scanner_.expect_end(element);
      out_.claims.push_back(*claim);
      claim_lines_.push_back(scanner_.line());
      next_keyword(element);
    }
  }

  void check_claims() const {
    for (std::size_t i = 0; i < out_.claims.size(); ++i) {
      if (out_.claims[i].kind == SpectrumClaimKind::regular) {
        if (!out_.regular) scanner_.fail_at(claim_lines_[i], "there is no block of this name", {"claim", i});
        continue;
      }
      const auto about = [&](const auto& r) { return r.valence == out_.claims[i].valence; };
      if (std::none_of(out_.rows.begin(), out_.rows.end(), about)) scanner_.fail_at(claim_lines_[i], "there is no row of this valence", {"claim", i});
    }
  }

  /// Files from before claims were named hold proved rows only.
  void imply_claims() {
    for (const auto& row : out_.rows) {
      for (const auto kind : {SpectrumClaimKind::ordering, SpectrumClaimKind::ring, SpectrumClaimKind::c1}) out_.claims.push_back({kind, row.valence});
    }
  }

  void row(Element element) {
    SpectrumCertificate::Row row;
    expect("row", element);
    row.valence = static_cast<int>(scanner_.integer("a valence", 3, kLargestValence, element));
    scanner_.expect_end(element);
    const auto same = [&](const auto& r) { return r.valence == row.valence; };
    if (std::any_of(out_.rows.begin(), out_.rows.end(), same)) scanner_.fail("a second row of this valence", element);
    next_keyword(element);
    row.mask = mask(row.valence, element);
    expect("cosine", element);
    row.cosine = interval(element);
    scanner_.expect_end(element);
    next_keyword(element);
    for (int m = 0; 2 * m <= row.valence; ++m) row.modes.push_back(mode(m, element));
    if (keyword_ == "ring") {
      SpectrumCertificate::Ring ring;
      ring.level = static_cast<int>(scanner_.integer("a level", 0, 64, element));
      ring.jacobian = scanner_.rational(element);
      ring.half_plane = scanner_.rational(element);
      scanner_.expect_end(element);
      row.ring = std::move(ring);
      next_keyword(element);
    }
    out_.rows.push_back(std::move(row));
  }

  /// Weights on one line, or blocks with a line for each of their rows.
  std::optional<ExtraordinaryMask> mask(int valence, Element element) {
    ExtraordinaryMask out;
    out.valence = valence;
    if (keyword_ == "weights" && out_.scheme) {
      const std::int64_t n = scanner_.integer("a number of weights", 0, kLargestValence, element);
      for (std::int64_t i = 0; i < n; ++i) out.weights.push_back(scanner_.rational(element));
      scanner_.expect_end(element);
    } else if (keyword_ == "blocks" && !out_.scheme) {
      const auto n = static_cast<std::size_t>(scanner_.integer("a number of rows", 1, 64, element));
      scanner_.expect_end(element);
      for (int d = 0; d < valence; ++d) out.blocks.push_back(block(n, element));
    } else {
      return std::nullopt;
    }
    next_keyword(element);
    return out;
  }

  std::vector<Rational> block(std::size_t n, Element element) {
    std::vector<Rational> out;
    for (std::size_t r = 0; r < n; ++r) {
      scanner_.expect_line("a row of a block", element);
      for (std::size_t c = 0; c < n; ++c) out.push_back(scanner_.rational(element));
      scanner_.expect_end(element);
    }
    return out;
  }

  RationalInterval interval(Element element) {
    RationalInterval r;
    r.lo = scanner_.rational(element);
    r.hi = scanner_.rational(element);
    return r;
  }

  ModeSpectrum mode(int m, Element element) {
    expect("mode", element);
    if (scanner_.integer("a mode", 0, kLargestValence, element) != m) scanner_.fail("expected mode " + std::to_string(m), element);
    const std::size_t n = scanner_.count("eigenvalues", 5, 64);
    scanner_.expect_end(element);
    ModeSpectrum out;
    for (std::size_t i = 0; i < n; ++i) {
      scanner_.expect_line("an eigenvalue", element);
      Eigenvalue e;
      e.mode = m;
      e.enclosure = interval(element);
      e.multiplicity = static_cast<int>(scanner_.integer("a multiplicity", 1, 64, element));
      scanner_.expect_end(element);
      out.isolated.push_back(std::move(e));
    }
    next_keyword(element);
    if (keyword_ == "disc") {
      out.remaining = static_cast<int>(scanner_.integer("a number of eigenvalues", 1, 64, element));
      out.remaining_bound = scanner_.rational(element);
      scanner_.expect_end(element);
      next_keyword(element);
    }
    return out;
  }

  void digest() {
    const std::string found(scanner_.expect_word("a digest"));
    scanner_.expect_end();
    const std::string expected = sha256_hex(bytes_.substr(0, scanner_.line_start()));
    if (found != expected) scanner_.fail("the digest does not match the bytes before this line, which have " + expected);
    if (scanner_.bytes_left() != 0) scanner_.fail("bytes follow the digest");
  }

  std::string_view bytes_;
  LineScanner scanner_;
  std::string_view keyword_;  ///< the first word of this line
  SpectrumCertificate out_;
  std::vector<std::uint64_t> claim_lines_;
};

void append_mask(std::string& text, const ExtraordinaryMask& mask) {
  if (mask.blocks.empty()) {
    text += "weights " + std::to_string(mask.weights.size());
    for (const Rational& w : mask.weights) text += " " + w.str();
    text += "\n";
    return;
  }
  std::size_t n = 1;
  while (n * n < mask.blocks.front().size()) ++n;
  text += "blocks " + std::to_string(n) + "\n";
  for (const std::vector<Rational>& block : mask.blocks) {
    for (std::size_t i = 0; i < block.size(); ++i) text += block[i].str() + (i % n + 1 == n ? "\n" : " ");
  }
}

void append_row(std::string& text, const SpectrumCertificate::Row& row) {
  text += "row " + std::to_string(row.valence) + "\n";
  if (row.mask) append_mask(text, *row.mask);
  text += "cosine " + row.cosine.lo.str() + " " + row.cosine.hi.str() + "\n";
  for (std::size_t m = 0; m < row.modes.size(); ++m) {
    const ModeSpectrum& mode = row.modes[m];
    text += "mode " + std::to_string(m) + " " + std::to_string(mode.isolated.size()) + "\n";
    for (const Eigenvalue& e : mode.isolated) {
      text += e.enclosure.lo.str() + " " + e.enclosure.hi.str() + " " + std::to_string(e.multiplicity) + "\n";
    }
    if (mode.remaining > 0) text += "disc " + std::to_string(mode.remaining) + " " + mode.remaining_bound.str() + "\n";
  }
  if (row.ring) text += "ring " + std::to_string(row.ring->level) + " " + row.ring->jacobian.str() + " " + row.ring->half_plane.str() + "\n";
}

}  // namespace

bool is_spectrum_certificate(std::string_view bytes) { return bytes.substr(0, kKeyword.size()) == kKeyword; }

std::string spectrum_certificate_text(const SpectrumCertificate& certificate) {
  std::string text = std::string(kKeyword) + " 1\n";
  for (std::string comment : certificate.provenance) {
    std::replace(comment.begin(), comment.end(), '\n', ' ');
    text += "# " + comment + "\n";
  }
  text += "scheme " + (certificate.scheme ? std::string(name_of(*certificate.scheme)) : std::string(kBlocks)) + "\n";
  text += "claims " + std::to_string(certificate.claims.size()) + "\n";
  for (const SpectrumClaim& claim : certificate.claims) text += "claim " + text_of(claim) + "\n";
  text += "rows " + std::to_string(certificate.rows.size()) + "\n";
  for (const SpectrumCertificate::Row& row : certificate.rows) append_row(text, row);
  if (certificate.regular) text += regular_evidence_text(*certificate.regular);
  const std::string digest = sha256_hex(text);
  return text += "sha256 " + digest + "\n";
}

SpectrumCertificate parse_spectrum_certificate(std::string_view bytes, const std::string& name) { return Reader(bytes, name).read(); }

bool is_spectrum_certificate_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::array<char, kKeyword.size()> first{};
  file.read(first.data(), first.size());
  return is_spectrum_certificate(std::string_view(first.data(), static_cast<std::size_t>(file.gcount())));
}

SpectrumCertificate read_spectrum_certificate(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw FileError("cannot be opened", path);
  std::string bytes;
  std::array<char, 1 << 16> block;
  while (file.read(block.data(), block.size()), file.gcount() > 0) {
    bytes.append(block.data(), static_cast<std::size_t>(file.gcount()));
    if (bytes.size() > kLargestFile) throw ResourceLimit(path + ": a spectral certificate has at most 256 MiB");
  }
  return parse_spectrum_certificate(bytes, path);
}

}  // namespace hexact::io
