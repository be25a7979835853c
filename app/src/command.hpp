// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/kernel/progress.hpp"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <string>

namespace hexact::app {

/// Exit status, as documented in docs/command-line.md.
enum ExitCode : int {
  kDone = 0,
  kClaimFails = 1,
  kUsage = 2,
  kBadInput = 3,
  kResourceLimit = 4,
  kUndecided = 5,
  kDefect = 70,
};

/// A command line that is well formed but asks for something that does not exist: exit 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Options that every subcommand understands.
struct Common {
  bool json = false;
  bool quiet = false;
  bool progress = false;
  int threads = 0;                    ///< 0: all cores
  std::uint64_t max_facets = 0;       ///< 0: no bound
  std::uint64_t max_memory = 0;       ///< bytes; 0: no bound
  std::string unit;                   ///< "", "mm", "m" or "in"
  // Set by main before the subcommand runs:
  ProgressPart work;                                ///< what the subcommand has done, and whether it shall end
  std::function<void(const std::string&)> remark;   ///< a line on standard error; nothing under --quiet
};

/// What a finished subcommand hands back: an exit status, the JSON report and the text for people.
struct Outcome {
  int exit_code = kDone;
  nlohmann::ordered_json report = nlohmann::ordered_json::object();
  std::string text;
};

/// A subcommand registers its options and the function to run. `selected` is set to that function by the
/// callback of the chosen subcommand; main runs it and turns exceptions into exit codes.
struct Registry {
  CLI::App& root;
  Common& common;
  std::function<Outcome()>& selected;

  /// Adds a subcommand with the common options.
  CLI::App* add(const std::string& name, const std::string& description) const;
};

// One function per subcommand, each in a source file of its name.
void add_make(const Registry&);
void add_convert(const Registry&);
void add_info(const Registry&);
void add_prepare(const Registry&);
void add_subdivide(const Registry&);
void add_certify(const Registry&);
void add_check(const Registry&);
void add_crosscheck(const Registry&);
void add_bench(const Registry&);
void add_spectrum(const Registry&);

}  // namespace hexact::app
