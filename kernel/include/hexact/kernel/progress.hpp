// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/kernel/errors.hpp"

#include <algorithm>
#include <atomic>

namespace hexact {

/// Work that ended because someone called Progress::cancel. Nothing was changed or written half.
class Cancelled : public Error {
 public:
  Cancelled() : Error("Cancelled", "cancelled") {}
};

/// How far long work has come, and the way to end it from outside. It outlives the work; every function may be called
/// from any thread, `cancel` also from a signal handler.
class Progress {
 public:
  /// From 0 to 1; never falls.
  [[nodiscard]] double fraction() const noexcept { return fraction_.load(std::memory_order_relaxed); }
  /// Asks the work to end with Cancelled at the next occasion. Cannot be taken back.
  void cancel() noexcept { cancelled_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] bool cancelled() const noexcept { return cancelled_.load(std::memory_order_relaxed); }
  /// The work has come this far; smaller values than before are ignored.
  void raise(double fraction) noexcept {
    const double goal = std::clamp(fraction, 0.0, 1.0);
    double now = fraction_.load(std::memory_order_relaxed);
    while (now < goal && !fraction_.compare_exchange_weak(now, goal, std::memory_order_relaxed)) {
    }
  }

 private:
  std::atomic<double> fraction_{0};
  std::atomic<bool> cancelled_{false};
  static_assert(std::atomic<bool>::is_always_lock_free);
};

/// The share of a Progress that one piece of work fills. By default there is none: nobody looks on. A value to be
/// passed on; the Progress must outlive it.
class ProgressPart {
 public:
  ProgressPart() = default;
  explicit ProgressPart(Progress& progress) : progress_(&progress) {}

  /// The share from `from` to `to` of this part, 0 <= from <= to <= 1.
  [[nodiscard]] ProgressPart part(double from, double to) const noexcept {
    ProgressPart inner = *this;
    inner.begin_ = begin_ + from * length_;
    inner.length_ = (to - from) * length_;
    return inner;
  }
  [[nodiscard]] bool cancelled() const noexcept { return progress_ != nullptr && progress_->cancelled(); }
  /// Throws Cancelled when someone has asked for it.
  void check() const {
    if (cancelled()) throw Cancelled();
  }
  /// This part is done up to `fraction`. Throws as `check`.
  void report(double fraction) const {
    check();
    if (progress_ != nullptr) progress_->raise(begin_ + fraction * length_);
  }

 private:
  Progress* progress_ = nullptr;
  double begin_ = 0, length_ = 1;
};

}  // namespace hexact
