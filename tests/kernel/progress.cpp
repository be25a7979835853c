// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/kernel/progress.hpp"

#include <catch2/catch.hpp>

#include <thread>
#include <vector>

using namespace hexact;

TEST_CASE("the fraction never falls, whatever threads report, and ends where the largest report was", "[progress]") {
  Progress progress;
  std::atomic<bool> stop{false};
  bool fell = false;
  std::thread onlooker([&] {
    double before = 0;
    while (!stop) {
      const double now = progress.fraction();
      fell = fell || now < before;
      before = now;
    }
  });
  std::vector<std::thread> workers;
  for (int w = 0; w < 3; ++w) {
    workers.emplace_back([&, w] {
      for (int i = 0; i <= 20000; ++i) ProgressPart(progress).part(0.1 * w, 0.6 + 0.1 * w).report(i / 20000.0);
    });
  }
  for (auto& worker : workers) worker.join();
  stop = true;
  onlooker.join();
  CHECK_FALSE(fell);
  CHECK(progress.fraction() == Approx(0.8));
  progress.raise(0.3);
  CHECK(progress.fraction() == Approx(0.8));
  progress.raise(7);
  CHECK(progress.fraction() == 1);
}

TEST_CASE("parts of parts fill their share", "[progress]") {
  Progress progress;
  const ProgressPart half = ProgressPart(progress).part(0.5, 1);
  half.report(0);
  CHECK(progress.fraction() == 0.5);
  half.part(0.5, 1).report(0.5);
  CHECK(progress.fraction() == 0.875);
  ProgressPart().report(1);  // nobody looks on
  CHECK(progress.fraction() == 0.875);
}

TEST_CASE("cancelling is sticky and ends work in all parts", "[progress]") {
  Progress progress;
  const ProgressPart part = ProgressPart(progress).part(0.25, 0.5);
  part.check();
  std::thread([&] { progress.cancel(); }).join();
  CHECK(part.cancelled());
  CHECK_THROWS_AS(part.check(), Cancelled);
  CHECK_THROWS_AS(part.report(1), Cancelled);
  CHECK_THROWS_AS(part.part(0, 1).check(), Cancelled);
  CHECK(progress.fraction() == 0);
  ProgressPart().check();
}
