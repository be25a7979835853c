// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/kernel/progress.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace hexact::validation {

/// A folder of its own below the system's temporary folder, removed with all it holds at the end of its life.
class TemporaryFolder {
 public:
  /// Throws FileError when none can be made.
  TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder();
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

/// How a child process ended.
struct ChildResult {
  enum class End { exited, signalled, timed_out, not_started } end = End::not_started;
  int status = 0;       ///< exit status, signal, or errno when not started
  double seconds = 0;   ///< wall time
  std::string output;   ///< standard output and error, together, at most 1 MiB
};

/// Runs a program without a shell, found by PATH unless its name has a slash, in `folder`, with no input. The child
/// leads a process group of its own, which is killed whole when `seconds_limit` is over; it also dies with us and
/// may write no file above 1 GiB. Never throws for what the child does; throws Cancelled, the child having ended, when
/// `progress` is cancelled. Cost: looks every few milliseconds.
[[nodiscard]] ChildResult run_child(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                                    double seconds_limit, const ProgressPart& progress = {});

}  // namespace hexact::validation
