// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

// Edits of a text that is read by lines: some change nothing, the others leave words where none belong.
namespace hexact::layout_edits {

struct Edit {
  std::string text, what;
  bool is_harmless;
};

/// The lines of a certificate after its first, without the digest and comments: each of them joined to the next, cut at
/// each of its blanks, with a comment behind it; and with a comment, an empty line or blanks before it. Without digest.
inline std::vector<Edit> of(const std::string& certificate) {
  const std::size_t last = certificate.rfind("sha256 ");
  std::vector<Edit> out;
  const std::string text = certificate.substr(0, last);
  for (std::size_t at = text.find('\n') + 1; at < last;) {
    const std::size_t end = text.find('\n', at), next = end + 1;
    const std::string line = text.substr(at, end - at);
    const auto add = [&](const std::string& by, const char* what, bool is_harmless) {
      if (line[0] != '#') out.push_back({text.substr(0, at) + by + text.substr(next), what + (": " + line), is_harmless});
    };
    for (const char* before : {" ", "\t", "\n", "# nothing\n", " # nothing\n", "#\n\r\n"}) add(before + line + "\n", "behind something", true);
    for (const char* behind : {" ", "\r", "\n\n", "\n#"}) add(line + behind + "\n", "before something", true);
    if (next < last) add(line + " ", "joined to the next", false);
    for (const char* comment : {" # nothing", " #", " 0"}) add(line + comment + "\n", "with more behind it", false);
    for (std::size_t blank = line.find(' '); blank != std::string::npos; blank = line.find(' ', blank + 1)) {
      add(line.substr(0, blank) + "\n" + line.substr(blank + 1) + "\n", "cut", false);
    }
    at = next;
  }
  return out;
}

}  // namespace hexact::layout_edits
