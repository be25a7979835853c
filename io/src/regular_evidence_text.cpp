// SPDX-License-Identifier: LGPL-3.0-or-later
#include "regular_evidence_text.hpp"

namespace hexact::io {
namespace {

constexpr std::int64_t kMost = 64;  // vertices, their entries, directions, weights
constexpr std::int64_t kLongestWord = 4;

std::string vertices_text(const MassGrowth& growth) {
  std::string text = "vertices " + std::to_string(growth.vertices.size()) + "\n";
  for (std::size_t v = 0; v < growth.vertices.size(); ++v) {
    const MassGrowth::Vertex& vertex = growth.vertices[v];
    text += v == 0 ? std::to_string(vertex.entries.size()) : std::to_string(vertex.parent) + " " + std::to_string(vertex.digit);
    for (const Integer& x : vertex.entries) text += " " + x.str();
    text += "\n";
  }
  return text;
}

std::string images_text(const MassGrowth& growth) {
  std::string text = "images " + std::to_string(growth.images.size()) + "\n";
  for (const MassGrowth::Image& image : growth.images) {
    text += std::to_string(image.vertex) + " " + std::to_string(image.digit) + " " + std::to_string(image.combination.size());
    for (const auto& [v, weight] : image.combination) text += " " + std::to_string(v) + " " + weight.str();
    text += "\n";
  }
  return text;
}

class Reader {
 public:
  explicit Reader(LineScanner& scanner) : scanner_(scanner) {}

  RegularEvidence read() {
    RegularEvidence out;
    out.continuity = static_cast<int>(scanner_.integer("an order", 0, kMost));
    scanner_.expect_end();
    for (std::size_t n = counted("directions"); n > 0; --n) {
      scanner_.expect_line("a direction");
      const auto x = static_cast<int>(scanner_.integer("a coordinate", -kMost, kMost));
      out.directions.push_back({x, static_cast<int>(scanner_.integer("a coordinate", -kMost, kMost))});
      scanner_.expect_end();
    }
    keyword("smoothing");
    for (std::size_t n = index("a number of weights", kMost); n > 0; --n) out.link.push_back(scanner_.rational({}));
    scanner_.expect_end();
    if (!out.link.empty()) out.growth = growth();
    return out;
  }

 private:
  void keyword(const char* word) {
    scanner_.expect_line(word);
    if (scanner_.word() != word) scanner_.fail(std::string("expected ") + word);
  }

  /// A line with a keyword and the number of lines that follow.
  std::size_t counted(const char* word) {
    keyword(word);
    const std::size_t n = scanner_.count(word, 4, kMost);
    scanner_.expect_end();
    return n;
  }

  std::size_t index(const char* what, std::int64_t high) { return static_cast<std::size_t>(scanner_.integer(what, 0, high)); }

  MassGrowth growth() {
    MassGrowth out;
    keyword("growth");
    out.bounds.lo = scanner_.rational({});
    out.bounds.hi = scanner_.rational({});
    scanner_.expect_end();
    keyword("word");
    for (std::size_t n = index("a number of digits", kLongestWord); n > 0; --n) out.word.push_back(static_cast<int>(index("a digit", 1)));
    scanner_.expect_end();
    std::size_t entries = 0;
    for (std::size_t n = counted("vertices"); n > 0; --n) {
      MassGrowth::Vertex vertex;
      scanner_.expect_line("a vertex");
      if (out.vertices.empty()) {
        entries = index("a number of entries", kMost);
      } else {
        vertex.parent = index("a vertex", kMost);
        vertex.digit = static_cast<int>(index("a digit", 1));
      }
      for (std::size_t i = 0; i < entries; ++i) vertex.entries.push_back(integer());
      scanner_.expect_end();
      out.vertices.push_back(std::move(vertex));
    }
    for (std::size_t n = counted("images"); n > 0; --n) out.images.push_back(image());
    return out;
  }

  Integer integer() {
    const Rational x = scanner_.rational({});
    if (x.denominator() != Integer(1)) scanner_.fail("expected an integer");
    return x.numerator();
  }

  MassGrowth::Image image() {
    MassGrowth::Image out;
    scanner_.expect_line("an image");
    out.vertex = index("a vertex", kMost);
    out.digit = static_cast<int>(index("a digit", 1));
    for (std::size_t n = index("a number of weights", kMost); n > 0; --n) {
      const std::size_t v = index("a vertex", kMost);
      out.combination.emplace_back(v, scanner_.rational({}));
    }
    scanner_.expect_end();
    return out;
  }

  LineScanner& scanner_;
};

}  // namespace

std::string regular_evidence_text(const RegularEvidence& evidence) {
  std::string text = "regular " + std::to_string(evidence.continuity) + "\ndirections " + std::to_string(evidence.directions.size()) + "\n";
  for (const Symbol::Vector& v : evidence.directions) text += std::to_string(v[0]) + " " + std::to_string(v[1]) + "\n";
  text += "smoothing " + std::to_string(evidence.link.size());
  for (const Rational& c : evidence.link) text += " " + c.str();
  text += "\n";
  if (!evidence.growth) return text;
  const MassGrowth& growth = *evidence.growth;
  text += "growth " + growth.bounds.lo.str() + " " + growth.bounds.hi.str() + "\nword " + std::to_string(growth.word.size());
  for (const int digit : growth.word) text += " " + std::to_string(digit);
  return text + "\n" + vertices_text(growth) + images_text(growth);
}

RegularEvidence read_regular_evidence(LineScanner& scanner) { return Reader(scanner).read(); }

}  // namespace hexact::io
