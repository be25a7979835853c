// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <string>

namespace bench {

/// Wall time and peak memory of one job: both are counted from construction on.
class Measure {
 public:
  Measure() : resident_before_(reset_peak()), begin_(Clock::now()) {}

  /// Stops the clock; call it once, when the timed work is done.
  void stop() {
    seconds_ = std::chrono::duration<double>(Clock::now() - begin_).count();
    peak_ = status_bytes("VmHWM:");
  }
  [[nodiscard]] double seconds() const noexcept { return seconds_; }

  /// One JSON line: name, facets, seconds (wall), threads, bytes_per_facet (growth of the peak resident size).
  void print(const std::string& name, std::size_t facets, int threads) const {
    const double bytes = static_cast<double>(peak_ - resident_before_) / static_cast<double>(facets);
    std::printf("{\"name\": \"%s\", \"facets\": %zu, \"seconds\": %.9f, \"threads\": %d, \"bytes_per_facet\": %.1f}\n",
                name.c_str(), facets, seconds_, threads, bytes);
    std::fflush(stdout);
  }

 private:
  using Clock = std::chrono::steady_clock;

  /// A size from /proc/self/status, in bytes; 0 where the system does not tell.
  static long long status_bytes(const std::string& key) {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;) {
      if (word == key) {
        long long kib = 0;
        status >> kib;
        return kib * 1024;
      }
    }
    return 0;
  }
  /// Makes the present resident size the peak so far, and returns it.
  static long long reset_peak() {
    std::ofstream("/proc/self/clear_refs") << "5";
    return status_bytes("VmRSS:");
  }

  long long resident_before_;
  long long peak_ = 0;
  double seconds_ = 0;
  Clock::time_point begin_;
};

}  // namespace bench
