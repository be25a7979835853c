// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "dice.hpp"
#include "hexact/exact/spectrum_certificate.hpp"
#include "hexact/io/mesh_file.hpp"
#include "hexact/io/spectrum_certificate_file.hpp"
#include "hexact/kernel/errors.hpp"
#include "program.hpp"

#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <map>
#include <string>
#include <vector>

// Edits of spectral certificates, and what the two checkers say of them.
namespace hexact::spectrum_test {

inline std::string with_digest(const std::string& text) {
  const std::string before = text.substr(0, text.rfind("sha256 "));
  return before + "sha256 " + io::sha256_hex(before) + "\n";
}

/// One edit of a digit, a sign, a word or a line, anywhere between the first line and the digest.
inline std::string edited(std::string text, Dice& dice) {
  const std::size_t first = text.find('\n') + 1, last = text.rfind("sha256 ");
  std::vector<std::size_t> digits, lines;
  for (std::size_t i = first; i < last; ++i) {
    if (text[i] >= '0' && text[i] <= '9') digits.push_back(i);
    if (text[i - 1] == '\n') lines.push_back(i);
  }
  const auto line_at = [&](std::size_t i) { return text.substr(i, text.find('\n', i) + 1 - i); };
  const std::size_t at = digits[dice.below(digits.size())], i = lines[dice.below(lines.size())], j = lines[dice.below(lines.size())];
  switch (dice.below(8)) {
    case 0: case 1: case 2: text[at] = static_cast<char>('0' + dice.below(10)); break;
    case 3: text.insert(at, 1, static_cast<char>('0' + dice.below(10))); break;
    case 4: text.erase(at, 1); break;
    case 5: {  // a small number: multiplicities, counts, levels, valences, short fractions
      const std::string line = line_at(i);
      const std::size_t blank = line.rfind(' ');
      text.replace(i + blank + 1, line.size() - blank - 2, std::to_string(dice.below(6)));
      break;
    }
    case 6: text.erase(i, line_at(i).size()); break;
    default: {
      const std::string a = line_at(i), b = line_at(j);
      text.replace(std::max(i, j), (i < j ? b : a).size(), i < j ? a : b);
      if (i != j) text.replace(std::min(i, j), (i < j ? a : b).size(), i < j ? b : a);
    }
  }
  return with_digest(text);
}

struct Outcome {
  int status = 0;
  std::map<std::string, std::string> claims;
};

inline Outcome by_library(const std::string& text) {
  Outcome out;
  try {
    const std::vector<ClaimVerdict> verdicts = verify(io::parse_spectrum_certificate(text, "test"));
    if (verdicts.empty()) return {3, {}};
    for (const ClaimVerdict& v : verdicts) {
      out.claims[v.claim] = name_of(v.verdict);
      if (v.verdict != Verdict::proved) {
        out.status = 1;
        CHECK(!v.witness.empty());
      }
    }
  } catch (const ParseError&) {
    return {3, {}};
  } catch (const ResourceLimit&) {
    return {4, {}};
  }
  return out;
}

inline Outcome by_checker(const program::Folder& folder, const std::string& text) {
  program::write_bytes(folder.path().string() + "/c.cert", text);
  const program::Run run = program::run(folder, "$check --json c.cert");
  Outcome out{run.status, {}};
  if (run.status > 1) return out;
  const nlohmann::json report = nlohmann::json::parse(run.out);
  for (const auto& [claim, verdict] : report["claims"].items()) out.claims[claim] = verdict;
  return out;
}

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  REQUIRE(at != std::string::npos);
  return with_digest(text.replace(at, what.size(), by));
}

}  // namespace hexact::spectrum_test
