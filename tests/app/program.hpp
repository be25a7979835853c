// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/validation/child_process.hpp"

#include <sys/wait.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <string>

// Runs the built programs as a user's shell does.
namespace hexact::program {

using Folder = validation::TemporaryFolder;

inline std::string read_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}
inline void write_bytes(const std::string& path, const std::string& bytes) { std::ofstream(path, std::ios::binary) << bytes; }

struct Run {
  int status = -1;  ///< exit status; 128 + signal
  std::string out, err;
};

/// A shell command line that runs in `folder`; $hexact and $check stand for the programs.
inline Run run(const Folder& folder, const std::string& command) {
  const std::string where = folder.path().string();
  const std::string line = "hexact='" HEXACT_BINARY_DIR "/hexact' check='" HEXACT_BINARY_DIR "/hexact-check'; cd '" + where +
                           "' && { " + command + " ; } >.out 2>.err </dev/null";
  const int status = std::system(line.c_str());
  Run result;
  result.status = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  result.out = read_bytes(where + "/.out");
  result.err = read_bytes(where + "/.err");
  return result;
}

}  // namespace hexact::program
