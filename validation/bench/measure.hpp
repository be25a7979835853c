// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/mman.h>

#include <chrono>
#include <cstddef>
#include <cstdio>
#include <fstream>
#include <string>

namespace bench {

/// Writes once to so much memory and gives it back. A virtual machine gets memory that it has never used from its host,
/// page by page and, measured, seventeen times as slowly as memory that it has used before: that is no part of a job,
/// and would make large jobs look slower than their work.
inline void use_memory_once(std::size_t bytes) {
  void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) return;  // the job may still fit
  (void)madvise(memory, bytes, MADV_HUGEPAGE);
  constexpr std::size_t kPage = 4096;
  for (std::size_t i = 0; i < bytes; i += kPage) static_cast<volatile char*>(memory)[i] = 1;
  (void)munmap(memory, bytes);
}

/// Wall time and peak memory of one job: both are counted from construction on. `memory` is about what it will need.
class Measure {
 public:
  explicit Measure(std::size_t memory = std::size_t{1} << 30)
      : resident_before_((use_memory_once(memory), reset_peak())), begin_(Clock::now()) {}

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
