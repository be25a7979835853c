// SPDX-License-Identifier: GPL-3.0-or-later
// hexact spectrum --regular, and its block in certificates under edits: hexact-check and the library agree.
#include "dice.hpp"
#include "hexact/io/mesh_file.hpp"
#include "hexact/kernel/errors.hpp"
#include "program.hpp"
#include "regular_samples.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>

using namespace hexact;
using spectrum_test::regular_certificate;

namespace {

std::string with_digest(const std::string& text) {
  const std::string before = text.substr(0, text.rfind("sha256 "));
  return before + "sha256 " + io::sha256_hex(before) + "\n";
}

/// Exit status 0, 1 or 3, the same by both programs.
int verdict(const program::Folder& folder, const std::string& text) {
  int by_library = 0;
  try {
    for (const ClaimVerdict& v : verify(io::parse_spectrum_certificate(text, "test"))) {
      if (v.verdict == Verdict::proved) continue;
      by_library = 1;
      CHECK(!v.witness.empty());
    }
  } catch (const ParseError&) {
    by_library = 3;
  }
  program::write_bytes(folder.path().string() + "/c.cert", text);
  const int by_checker = program::run(folder, "$check c.cert").status;
  CHECK(by_library == by_checker);
  return std::max(by_library, by_checker);
}

/// Where the numbers of the block begin, and how long their words are.
std::vector<std::pair<std::size_t, std::size_t>> numbers(const std::string& text) {
  std::vector<std::pair<std::size_t, std::size_t>> out;
  for (std::size_t i = text.find("\nregular ") + 1, end = text.rfind("sha256 "); i < end; ++i) {
    if ((text[i - 1] != ' ' && text[i - 1] != '\n') || (text[i] != '-' && (text[i] < '0' || text[i] > '9'))) continue;
    out.emplace_back(i, text.find_first_of(" \n", i) - i);
  }
  return out;
}

}  // namespace

TEST_CASE("certificates of regular regions are read back and proved by both checkers", "[regular][certificate]") {
  const program::Folder folder;
  for (const SpectrumScheme scheme : {SpectrumScheme::midedge, SpectrumScheme::midedge6, SpectrumScheme::loop, SpectrumScheme::catmull_clark, SpectrumScheme::doo_sabin}) {
    const std::string text = regular_certificate(scheme);
    CHECK(io::spectrum_certificate_text(io::parse_spectrum_certificate(text, "test")) == text);
    CHECK(verdict(folder, text) == 0);
    for (const char* other : {"midedge", "midedge6", "loop", "catmull-clark", "doo-sabin"}) {
      const std::string own = std::string("scheme ") + name_of(scheme) + "\n";
      std::string forged = text;
      forged.replace(forged.find(own), own.size(), std::string("scheme ") + other + "\n");
      CHECK(verdict(folder, with_digest(forged)) == (name_of(scheme) == std::string(other) ? 0 : 1));
    }
  }
}

TEST_CASE("a number of a certificate of regular regions cannot be changed, unless that leaves a proof", "[regular][certificate]") {
  const program::Folder folder;
  for (const SpectrumScheme scheme : {SpectrumScheme::midedge6, SpectrumScheme::catmull_clark}) {
    const std::string text = regular_certificate(scheme);
    const auto words = numbers(text);
    CHECK(words.size() == (scheme == SpectrumScheme::midedge6 ? 177U : 19U));
    int other_proofs = 0;
    for (const auto& [at, length] : words) {
      std::string edited = text;
      char& first = edited[text[at] == '-' ? at + 1 : at];
      first = static_cast<char>(first == '9' ? '1' : first + 1);
      INFO(text.substr(at, length) << " at " << at);
      const int status = verdict(folder, with_digest(edited));
      CHECK(program::run(folder, "$hexact check c.cert").status == status);
      if (status != 0) continue;
      ++other_proofs;
      CHECK(at > text.find("\nimages "));
      CHECK(text.substr(at, length) == "0");
    }
    CHECK(other_proofs == (scheme == SpectrumScheme::midedge6 ? 3 : 0));  // vertex 1 in place of 0 covers the image too
    std::string without_digest = text;
    ++without_digest[words.back().first];
    CHECK(verdict(folder, without_digest) == 3);
  }
}

TEST_CASE("what a forger would try with regular regions", "[regular][certificate]") {
  const program::Folder folder;
  const std::string text = regular_certificate(SpectrumScheme::midedge6);
  const auto with = [&](const std::string& what, const std::string& by) {
    std::string forged = text;
    const std::size_t at = forged.find(what);
    REQUIRE(at != std::string::npos);
    return verdict(folder, with_digest(forged.replace(at, what.size(), by)));
  };
  CHECK(with("regular 2\n", "regular 3\n") == 1);
  CHECK(with("regular 2\n", "regular 1\n") == 1);
  CHECK(with("smoothing 3 3/16 5/8 3/16", "smoothing 3 1/4 1/2 1/4") == 1);
  CHECK(with("smoothing 3 3/16 5/8 3/16", "smoothing 1 1") == 1);
  CHECK(with("smoothing 3 3/16 5/8 3/16", "smoothing 0") == 3);
  CHECK(with("1 0\n0 1\n", "0 1\n1 0\n") == 1);
  CHECK(with("directions 4\n1 0\n", "directions 3\n") == 1);
  CHECK(with("1 1\n1 -1\n", "1 1\n-1 1\n") == 1);
  CHECK(with("word 2 0 1", "word 2 1 0") == 0);           // the same eigenvalues
  CHECK(with("word 2 0 1", "word 4 0 1 0 1") == 0);       // the square
  CHECK(with("word 2 0 1", "word 2 1 1") == 1);
  CHECK(with("1 1 2 0 14263/65536 2 51273/65536", "1 1 3 0 14263/65536 2 51272/65536 2 1/65536") == 0);
  CHECK(with("1 1 2 0 14263/65536 2 51273/65536", "1 1 1 2 1") == 1);
  CHECK(with("1 1 2 0 14263/65536 2 51273/65536", "1 1 2 0 1/65536 2 65535/65536") == 1);
  CHECK(with("1 1 2 0 14263/65536 2 51273/65536", "1 1 3 0 1 2 1 3 -1") == 1);
}

TEST_CASE("edited certificates of regular regions: both checkers agree", "[regular][certificate]") {
  const program::Folder folder;
  const std::vector<std::string> originals{regular_certificate(SpectrumScheme::midedge6), regular_certificate(SpectrumScheme::loop),
                                           regular_certificate(SpectrumScheme::midedge)};
  constexpr std::uint64_t kSeed = 20261126;
  Dice dice(kSeed);
  std::map<int, int> count;
  for (int i = 0; i < 250; ++i) {
    std::string text = originals[static_cast<std::size_t>(i % 5 < 3 ? 0 : i % 5 - 2)];
    const std::size_t first = text.find("regular "), last = text.rfind("sha256 ");
    std::vector<std::size_t> lines;
    for (std::size_t c = first; c < last; ++c) {
      if (text[c - 1] == '\n') lines.push_back(c);
    }
    const auto words = numbers(text);
    const auto [at, length] = words[dice.below(words.size())];
    const std::size_t line = lines[dice.below(lines.size())], line_size = text.find('\n', line) + 1 - line;
    switch (dice.below(5)) {
      case 0: text[at + length - 1] = static_cast<char>('0' + dice.below(10)); break;
      case 1: text.replace(at, length, std::to_string(dice.below(4))); break;
      case 2: text.insert(at, 1, '-'); break;
      case 3: text.erase(line, line_size); break;
      default: text.insert(lines[dice.below(lines.size())], text.substr(line, line_size));
    }
    INFO("seed " << kSeed << ", edit " << i << ":\n" << text);
    ++count[verdict(folder, with_digest(text))];
  }
  CHECK(count[1] > 40);
  CHECK(count[3] > 40);
}

TEST_CASE("spectrum --regular: text, JSON, certificates, exit codes", "[regular][program]") {
  const program::Folder folder;
  const auto run = [&](const std::string& arguments) { return program::run(folder, "$hexact spectrum " + arguments); };
  program::Run r = run("--scheme midedge6 --regular --json");
  CHECK(r.status == 0);
  auto report = nlohmann::json::parse(r.out);
  CHECK(report["verdict"] == "proved");
  CHECK(report["rows"].empty());
  const auto regular = report["regular"];
  CHECK(regular["continuity"] == 2);
  CHECK(regular["exponent"] == nlohmann::json::array({"0.9816730980429215485290212254", "0.9816730980429215485290212255"}));
  CHECK(regular["step_symbol"] == "(x + y)(1 + 3xy)/4");
  CHECK(regular["growth"]["product"] == "T0 T1");
  CHECK(regular["growth"]["vertices"] == 12);
  CHECK(regular["smoothing"].size() == 17);
  CHECK(regular["quadratic_limit"] == nlohmann::json::array({"5/16", "0", "5/16"}));
  r = run("--scheme loop --regular --valence 5..6 --json --certificate c.cert");
  CHECK(r.status == 0);
  report = nlohmann::json::parse(r.out);
  CHECK(report["rows"].size() == 2);
  CHECK(report["regular"]["continuity"] == 2);
  CHECK(report["regular"]["growth"].is_null());
  r = program::run(folder, "$hexact check --json c.cert");
  CHECK(r.status == 0);
  CHECK(nlohmann::json::parse(r.out)["claims"].size() == 7);
  r = program::run(folder, "$check --json c.cert");
  CHECK(r.status == 0);
  CHECK(nlohmann::json::parse(r.out)["claims"]["regular"] == "proved");
  CHECK(nlohmann::json::parse(r.out)["claims"].size() == 7);
  r = run("--scheme midedge --regular");
  CHECK(r.status == 0);
  CHECK(r.out.find("C^1, derivatives of order 1 Lipschitz continuous, not C^2") != std::string::npos);
  CHECK(run("--scheme midedge --regular --valence 3 --certificate d.cert").status == 1);  // the row is refuted
  r = program::run(folder, "$check d.cert");
  CHECK(r.status == 0);
  CHECK(r.out == "scheme: midedge\nordering-fails=3: proved\nregular: proved\nproved\n");
  CHECK(program::run(folder, "sed -i '/^claim regular/d; s/^claims 2/claims 1/; /^sha256/d' d.cert; "
                             "echo sha256 $(sha256sum < d.cert | cut -d' ' -f1) >> d.cert; $check d.cert && $hexact check d.cert").out ==
        "scheme: midedge\nordering-fails=3: proved\nproved\nscheme: midedge\nordering-fails=3: proved\nproved\n");  // a block without claim is not read as one
  CHECK(program::run(folder, "sed -i 's/^claim ordering-fails=3/claim regular/; /^regular/,$d' d.cert; "
                             "echo sha256 $(sha256sum < d.cert | cut -d' ' -f1) >> d.cert; $check d.cert").status == 3);
  CHECK(program::run(folder, "$hexact check d.cert").status == 3);
  CHECK(run("--scheme midedge6 --regular --picture p.svg").status == 2);
  CHECK(run("--scheme midedge6 --regular --matrix m.json").status == 2);
  CHECK(run("--masks m.json --regular").status == 2);
  CHECK(run("--scheme phs --regular").status == 2);
}
