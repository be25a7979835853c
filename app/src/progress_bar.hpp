// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/kernel/progress.hpp"

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace hexact::app {

/// Draws a Progress on standard error, ten times a second, until it is destroyed or stopped.
class ProgressBar {
 public:
  /// When to draw: never; once the work takes longer than half a second, wiped away at the end; from the beginning, and
  /// left standing.
  enum class Mode { off, passing, lasting };
  ProgressBar(const Progress& progress, Mode mode);
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;
  ~ProgressBar() { stop(); }
  /// Draws for the last time.
  void stop();
  /// A line of text on standard error, above the bar.
  void print(const std::string& line);

 private:
  void run();
  void draw();
  void wipe();

  const Progress& progress_;
  const Mode mode_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool ended_ = false;
  int drawn_percent_ = -1;  ///< what stands on the line now; -1: nothing
  std::thread thread_;
};

/// While it lives, SIGINT and SIGTERM cancel the Progress, and a second one ends the program at once; so does the first
/// while the fraction is 0: whoever has read the input and begins to work or to write reports more than that. Signals
/// that are ignored stay ignored.
class Interruption {
 public:
  explicit Interruption(Progress& progress);
  Interruption(const Interruption&) = delete;
  Interruption& operator=(const Interruption&) = delete;
  ~Interruption();
  /// The signal that came; 0: none.
  [[nodiscard]] static int signal() noexcept;
};

}  // namespace hexact::app
