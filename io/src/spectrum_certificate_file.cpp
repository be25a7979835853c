// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/io/spectrum_certificate_file.hpp"

#include "hexact/io/mesh_file.hpp"
#include "hexact/kernel/errors.hpp"
#include "line_scanner.hpp"

#include <algorithm>
#include <array>
#include <fstream>

namespace hexact::io {
namespace {

constexpr std::string_view kKeyword = "hexact-spectrum";
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
    keyword("scheme");
    out_.scheme = scheme(scanner_.expect_word("a scheme"));
    scanner_.expect_end();
    keyword("rows");
    const std::size_t rows = scanner_.count("rows", 8, kLargestValence);
    scanner_.expect_end();
    for (std::size_t i = 0; i < rows; ++i) row({"row", i});
    keyword("sha256");
    digest();
    out_.provenance = scanner_.comments();
    return std::move(out_);
  }

 private:
  void keyword(const char* word, Element element = {}) {
    scanner_.expect_line(word, element);
    if (scanner_.word() != word) scanner_.fail(std::string("expected ") + word, element);
  }

  SpectrumScheme scheme(std::string_view name) const {
    for (const SpectrumScheme s : {SpectrumScheme::midedge, SpectrumScheme::midedge6, SpectrumScheme::loop,
                                   SpectrumScheme::catmull_clark, SpectrumScheme::doo_sabin}) {
      if (name == name_of(s)) return s;
    }
    scanner_.fail("there is no scheme " + quoted(name));
  }

  void row(Element element) {
    SpectrumCertificate::Row row;
    keyword("row", element);
    row.valence = static_cast<int>(scanner_.integer("a valence", 3, kLargestValence, element));
    scanner_.expect_end(element);
    const auto same = [&](const auto& r) { return r.valence == row.valence; };
    if (std::any_of(out_.rows.begin(), out_.rows.end(), same)) scanner_.fail("a second row of this valence", element);
    keyword("cosine", element);
    row.cosine = interval(element);
    scanner_.expect_end(element);
    for (int m = 0; 2 * m <= row.valence; ++m) row.modes.push_back(mode(m, element));
    keyword("ring", element);
    row.level = static_cast<int>(scanner_.integer("a level", 0, 64, element));
    row.jacobian = scanner_.rational(element);
    row.half_plane = scanner_.rational(element);
    scanner_.expect_end(element);
    out_.rows.push_back(std::move(row));
  }

  RationalInterval interval(Element element) {
    RationalInterval r;
    r.lo = scanner_.rational(element);
    r.hi = scanner_.rational(element);
    return r;
  }

  std::vector<Eigenvalue> mode(int m, Element element) {
    keyword("mode", element);
    if (scanner_.integer("a mode", 0, kLargestValence, element) != m) scanner_.fail("expected mode " + std::to_string(m), element);
    const std::size_t n = scanner_.count("eigenvalues", 5, 64);
    scanner_.expect_end(element);
    std::vector<Eigenvalue> out;
    for (std::size_t i = 0; i < n; ++i) {
      scanner_.expect_line("an eigenvalue", element);
      Eigenvalue e;
      e.mode = m;
      e.enclosure = interval(element);
      e.multiplicity = static_cast<int>(scanner_.integer("a multiplicity", 1, 64, element));
      scanner_.expect_end(element);
      out.push_back(std::move(e));
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
  SpectrumCertificate out_;
};

}  // namespace

bool is_spectrum_certificate(std::string_view bytes) { return bytes.substr(0, kKeyword.size()) == kKeyword; }

std::string spectrum_certificate_text(const SpectrumCertificate& certificate) {
  std::string text = std::string(kKeyword) + " 1\n";
  for (std::string comment : certificate.provenance) {
    std::replace(comment.begin(), comment.end(), '\n', ' ');
    text += "# " + comment + "\n";
  }
  text += std::string("scheme ") + name_of(certificate.scheme) + "\nrows " + std::to_string(certificate.rows.size()) + "\n";
  for (const SpectrumCertificate::Row& row : certificate.rows) {
    text += "row " + std::to_string(row.valence) + "\ncosine " + row.cosine.lo.str() + " " + row.cosine.hi.str() + "\n";
    for (std::size_t m = 0; m < row.modes.size(); ++m) {
      text += "mode " + std::to_string(m) + " " + std::to_string(row.modes[m].size()) + "\n";
      for (const Eigenvalue& e : row.modes[m]) {
        text += e.enclosure.lo.str() + " " + e.enclosure.hi.str() + " " + std::to_string(e.multiplicity) + "\n";
      }
    }
    text += "ring " + std::to_string(row.level) + " " + row.jacobian.str() + " " + row.half_plane.str() + "\n";
  }
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
