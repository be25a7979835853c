// SPDX-License-Identifier: LGPL-3.0-or-later
// Reads certificates of spectra.
#include "spectrum.hpp"

#include "certificate_text.hpp"
#include "sha256.hpp"

#include <algorithm>
#include <fstream>

namespace check {
namespace {

const std::vector<std::string> kSchemes{"midedge", "midedge6", "loop", "catmull-clark", "doo-sabin", "blocks"};
const std::vector<std::string> kStatements{"ordering", "ring", "c1", "ordering-fails", "ring-fails", "c1-fails"};

class SpectrumReader {
 public:
  SpectrumReader(std::string_view bytes, const std::string& path) : in_(bytes, path, Layout::lines) {}
  SpectrumFile read() {
    word_ = in_.word(), need("hexact-spectrum");
    if (in_.word() != "1") in_.fail("only version 1 is known");
    next(), need("scheme");
    word_ = in_.word();
    const auto found = std::find(kSchemes.begin(), kSchemes.end(), word_);
    if (found == kSchemes.end()) in_.fail("there is no scheme " + std::string(word_));
    file_.scheme = static_cast<Scheme>(found - kSchemes.begin());
    next();
    const bool names_claims = word_ == "claims";
    std::vector<std::string> claims;
    if (names_claims) {
      const std::int64_t n = in_.integer(0, 6001);
      next();
      for (std::int64_t i = 0; i < n; ++i) need("claim"), claims.emplace_back(in_.word()), next();
    }
    need("rows");
    const std::int64_t rows = in_.integer(0, 1000);
    next();
    for (std::int64_t i = 0; i < rows; ++i) add_row();
    if (!names_claims) {  // files from before claims were named
      for (const ListedRow& r : file_.rows) {
        for (std::size_t s = 0; s < 3; ++s) claims.push_back(kStatements[s] + "=" + std::to_string(r.k));
      }
    }
    if (word_ == "regular" && names_claims && file_.scheme != Scheme::blocks) file_.regular = read_regular(in_), next();
    for (const std::string& c : claims) add_claim(c);
    need("sha256");
    digest_ = in_.word();
    next();
    if (!word_.empty()) in_.fail("bytes follow the digest");
    return std::move(file_);
  }

  // The word behind sha256, once all is read.
  std::string_view digest() const { return digest_; }

 private:
  // To the next line, and its first word.
  void next() { in_.next_line(), word_ = in_.word(); }
  void need(const std::string& expected) const {
    if (word_ != expected) in_.fail("expected " + expected);
  }
  mpq_class number() { return in_.number(in_.word(), false).a; }

  void add_claim(const std::string& text) {
    const auto same = [&](const SpectrumClaim& c) { return c.text == text; };
    if (std::any_of(file_.claims.begin(), file_.claims.end(), same)) in_.fail("the claim " + text + " is there twice");
    if (text == "regular" && file_.regular) {
      file_.claims.push_back({text, Statement::regular, file_.rows.size()});
      return;
    }
    for (std::size_t row = 0; row < file_.rows.size(); ++row) {
      for (std::size_t s = 0; s < kStatements.size(); ++s) {
        if (text != kStatements[s] + "=" + std::to_string(file_.rows[row].k)) continue;
        file_.claims.push_back({text, static_cast<Statement>(s), row});
        return;
      }
    }
    in_.fail("there is no claim " + text + ", or nothing that it is about");
  }

  void add_row() {
    ListedRow r;
    need("row"), r.k = static_cast<int>(in_.integer(3, 1000));
    for (const ListedRow& other : file_.rows) {
      if (other.k == r.k) in_.fail("a second row of this valence");
    }
    next();
    if (word_ == "weights" && file_.scheme != Scheme::blocks) weights(r);
    else if (word_ == "blocks" && file_.scheme == Scheme::blocks) blocks(r);
    need("cosine"), r.cosine_lo = number(), r.cosine_hi = number(), next();
    for (int m = 0; 2 * m <= r.k; ++m) r.modes.push_back(mode(m));
    if (word_ == "ring") {
      RingBounds ring;
      ring.level = static_cast<int>(in_.integer(0, 64)), ring.jacobian = number(), ring.half_plane = number();
      r.ring = ring;
      next();
    }
    file_.rows.push_back(std::move(r));
  }
  void weights(ListedRow& r) {
    Mask mask;
    for (std::int64_t n = in_.integer(0, 1000); n > 0; --n) mask.weights.push_back(number());
    r.mask = std::move(mask);
    next();
  }
  void blocks(ListedRow& r) {
    Mask mask;
    mask.side = static_cast<int>(in_.integer(1, 64));
    for (int d = 0; d < r.k; ++d) {
      mask.blocks.emplace_back();
      for (int i = 0; i < mask.side * mask.side; ++i) {
        if (i % mask.side == 0) in_.next_line();
        mask.blocks.back().push_back(number());
      }
    }
    r.mask = std::move(mask);
    next();
  }
  ListedMode mode(int m) {
    ListedMode out;
    need("mode"), in_.integer(m, m);
    for (std::int64_t n = in_.integer(0, 64); n > 0; --n) {
      in_.next_line();
      const mpq_class lo = number(), hi = number();
      out.values.push_back({lo, hi, static_cast<int>(in_.integer(1, 64))});
    }
    next();
    if (word_ == "disc") out.rest = static_cast<int>(in_.integer(1, 64)), out.radius = number(), next();
    return out;
  }

  Scanner in_;
  std::string_view word_, digest_;
  SpectrumFile file_;
};

const std::string& name_of(Scheme scheme) { return kSchemes[static_cast<std::size_t>(scheme)]; }

std::string json_array(const std::vector<mpq_class>& numbers) {
  std::string out;
  for (const mpq_class& x : numbers) out += (out.empty() ? "\"" : ", \"") + x.get_str() + "\"";
  return "[" + out + "]";
}

}  // namespace

std::string subject_json(const SpectrumFile& file) {
  std::string masks;
  for (const ListedRow& row : file.rows) {
    if (!row.mask) continue;
    std::string blocks;
    for (const auto& block : row.mask->blocks) blocks += (blocks.empty() ? "" : ", ") + json_array(block);
    masks += (masks.empty() ? "\"" : ", \"") + std::to_string(row.k) + "\": " + (blocks.empty() ? json_array(row.mask->weights) : "[" + blocks + "]");
  }
  return "\"scheme\": \"" + name_of(file.scheme) + "\"" + (masks.empty() ? "" : ", \"masks\": {" + masks + "}");
}

std::string subject_text(const SpectrumFile& file) {
  std::string out = "scheme: " + name_of(file.scheme) + "\n";
  for (const ListedRow& row : file.rows) {
    if (!row.mask) continue;
    out += "mask " + std::to_string(row.k) + ":";
    for (const mpq_class& x : row.mask->weights) out += " " + x.get_str();
    out += row.mask->blocks.empty() ? "\n" : " blocks, see --json\n";
  }
  return out;
}

bool is_spectrum_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::string first(15, '\0');
  in.read(first.data(), 15);
  return first == "hexact-spectrum";
}

SpectrumFile parse_spectrum(std::string_view bytes, const std::string& name) {
  SpectrumReader reader(bytes, name);
  SpectrumFile file = reader.read();
  const std::string expected = sha256(bytes.substr(0, last_line(bytes)));
  if (!has_digest(bytes)) throw Malformed(name, 0, "bytes follow the digest");
  if (reader.digest() != expected) throw Malformed(name, 0, "the digest does not match the bytes before it, which have " + expected);
  return file;
}

SpectrumFile read_spectrum(const std::string& path) { return parse_spectrum(read_file(path), path); }

}  // namespace check
