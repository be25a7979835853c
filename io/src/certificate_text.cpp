// SPDX-License-Identifier: LGPL-3.0-or-later
#include "number_text.hpp"
#include "plane_text.hpp"
#include "readers.hpp"

#include "hexact/io/mesh_file.hpp"
#include "hexact/kernel/errors.hpp"

#include <algorithm>
#include <array>

namespace hexact::io {
namespace {

/// The claims whose reference is a body block of the certificate.
bool refers_to_body(std::string_view claim) {
  constexpr std::array<std::string_view, 3> kNames = {"inside", "tangent", "corner-cut-of"};
  return std::find(kNames.begin(), kNames.end(), claim) != kNames.end();
}

class CertificateReader {
 public:
  CertificateReader(std::string_view bytes, const std::string& name)
      : bytes_(bytes), scanner_(bytes, name, LineScanner::Comments::whole_lines) {}

  Certificate read() {
    if (!scanner_.next_line() || scanner_.word() != "hexact-certificate" || scanner_.word() != "1") {
      scanner_.fail("expected the first line hexact-certificate 1");
    }
    scanner_.expect_end();
    scanner_.expect_line("field");
    BodyText text = read_body(scanner_);
    certificate_.body = std::move(text.body);
    bool more = text.more;
    while (true) {
      if (!more) scanner_.fail("the file ends before the line sha256");
      const std::string_view keyword = scanner_.word();
      if (keyword == "sha256") break;
      more = record(keyword);
    }
    digest();
    check_references();
    certificate_.provenance = scanner_.comments();
    return std::move(certificate_);
  }

 private:
  /// One record after the body; returns whether a line follows.
  bool record(std::string_view keyword) {
    if (keyword == "body") {
      NamedBody named;
      named.name = scanner_.expect_word("the name of a body");
      scanner_.expect_end();
      if (find(named.name) != nullptr) scanner_.fail("a second body of the name " + quoted(named.name));
      scanner_.expect_line("field");
      BodyText text = read_body(scanner_);
      named.body = std::move(text.body);
      certificate_.bodies.push_back(std::move(named));
      return text.more;
    }
    if (keyword == "claim") {
      claim();
    } else if (keyword == "support") {
      support();
    } else {
      scanner_.fail("expected claim, body, support or sha256, found " + quoted(keyword));
    }
    return scanner_.next_line();
  }

  void claim() {
    const std::string_view word = scanner_.expect_word("a claim");
    scanner_.expect_end();
    const std::size_t equals = word.find('=');
    Claim claim{std::string(word.substr(0, equals)), {}};
    if (equals != std::string_view::npos) claim.reference = word.substr(equals + 1);
    if (claim.name.empty() || (equals != std::string_view::npos && claim.reference.empty())) {
      scanner_.fail("expected NAME or NAME=BODY, found " + quoted(word));
    }
    certificate_.claims.push_back(std::move(claim));
    claim_lines_.push_back(scanner_.line());
  }

  void support() {
    Support support;
    const Element element{"support", certificate_.supports.size()};
    support.reference = scanner_.expect_word("the name of a body", element);
    support.plane = static_cast<std::size_t>(scanner_.integer("a plane", 0, 0xfffffffe, element));
    support.vertex = make_id<VertexId>(static_cast<std::size_t>(
        scanner_.integer("a vertex", 0, static_cast<std::int64_t>(certificate_.body.vertex_count()) - 1, element)));
    scanner_.expect_end(element);
    certificate_.supports.push_back(std::move(support));
    support_lines_.push_back(scanner_.line());
  }

  /// The last line: the digest of all bytes before it.
  void digest() {
    const std::string found(scanner_.expect_word("a digest"));
    scanner_.expect_end();
    const std::string expected = sha256_hex(bytes_.substr(0, scanner_.line_start()));
    if (found != expected) scanner_.fail("the digest does not match the bytes before this line, which have " + expected);
    if (scanner_.bytes_left() != 0) scanner_.fail("bytes follow the digest");
  }

  const NamedBody* find(std::string_view name) const {
    for (const NamedBody& named : certificate_.bodies) {
      if (named.name == name) return &named;
    }
    return nullptr;
  }

  void check_references() const {
    for (std::size_t i = 0; i < certificate_.claims.size(); ++i) {
      const Claim& claim = certificate_.claims[i];
      if (refers_to_body(claim.name) && find(claim.reference) == nullptr) {
        scanner_.fail_at(claim_lines_[i], "there is no body " + quoted(claim.reference), {"claim", i});
      }
    }
    for (std::size_t i = 0; i < certificate_.supports.size(); ++i) {
      const Support& support = certificate_.supports[i];
      const NamedBody* named = find(support.reference);
      if (named == nullptr || support.plane >= named->body.plane_count()) {
        scanner_.fail_at(support_lines_[i],
                         "there is no plane " + std::to_string(support.plane) + " of a body " + quoted(support.reference),
                         {"support", i});
      }
    }
  }

  std::string_view bytes_;
  LineScanner scanner_;
  Certificate certificate_;
  std::vector<std::uint64_t> claim_lines_, support_lines_;
};

/// A word in the file: not empty, no blanks.
void require_word(const std::string& word) {
  if (word.empty() || word.find_first_of(" \t\r\n\f\v=") != std::string::npos) {
    throw InvalidInput("NotRepresentable", "a name in a certificate is one word without '='", word);
  }
}

void append_comment(std::string& text, std::string comment) {
  std::replace(comment.begin(), comment.end(), '\n', ' ');
  text += "# " + comment + "\n";
}

}  // namespace

Certificate parse_certificate(std::string_view bytes, const std::string& name) {
  return CertificateReader(bytes, name).read();
}

std::string certificate_text(const Certificate& certificate) {
  std::string text = "hexact-certificate 1\n";
  for (const std::string& comment : certificate.provenance) append_comment(text, comment);
  append_body(text, certificate.body);
  for (const Claim& claim : certificate.claims) {
    require_word(claim.name);
    text += "claim " + claim.name;
    if (!claim.reference.empty()) {
      require_word(claim.reference);
      text += "=" + claim.reference;
    }
    text += "\n";
  }
  for (const NamedBody& named : certificate.bodies) {
    require_word(named.name);
    text += "body " + named.name + "\n";
    append_body(text, named.body);
  }
  for (const Support& support : certificate.supports) {
    require_word(support.reference);
    append_integer(text += "support " + support.reference + " ", support.plane);
    append_integer(text += ' ', index(support.vertex)).push_back('\n');
  }
  const std::string digest = sha256_hex(text);
  return text += "sha256 " + digest + "\n";
}

}  // namespace hexact::io
