// SPDX-License-Identifier: GPL-3.0-or-later
#include "progress_bar.hpp"

#include <fmt/format.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <signal.h>

namespace hexact::app {
namespace {

constexpr int kCells = 40;

std::atomic<Progress*> interrupted_progress{nullptr};
std::atomic<int> received{0};
static_assert(std::atomic<Progress*>::is_always_lock_free && std::atomic<int>::is_always_lock_free &&
              std::atomic<double>::is_always_lock_free);

void on_signal(int number) {
  Progress* progress = interrupted_progress.load();
  if (progress == nullptr || progress->fraction() == 0) {
    std::raise(number);  // to the default action: nothing has begun, the program may be waiting for its input
    return;
  }
  received.store(number);
  progress->cancel();
}

void handle(int number, bool on) {
  struct sigaction now {};
  if (sigaction(number, nullptr, &now) != 0 || (now.sa_flags & SA_SIGINFO) != 0 || now.sa_handler == SIG_IGN) return;
  struct sigaction action {};
  action.sa_handler = on ? on_signal : SIG_DFL;
  // The handler is taken away by the first signal; reads and writes go on.
  action.sa_flags = on ? static_cast<int>(SA_RESETHAND | SA_RESTART) : 0;
  sigaction(number, &action, nullptr);
}

}  // namespace

ProgressBar::ProgressBar(const Progress& progress, Mode mode) : progress_(progress), mode_(mode) {
  if (mode != Mode::off) thread_ = std::thread([this] { run(); });
}

void ProgressBar::run() {
  std::unique_lock lock(mutex_);
  if (mode_ == Mode::passing && wake_.wait_for(lock, std::chrono::milliseconds(500), [this] { return ended_; })) return;
  do {
    draw();
  } while (!wake_.wait_for(lock, std::chrono::milliseconds(100), [this] { return ended_; }));
  if (mode_ == Mode::passing) {
    wipe();
  } else {
    draw();
    std::fputc('\n', stderr);
  }
}

void ProgressBar::draw() {
  const double fraction = progress_.fraction();
  const int percent = static_cast<int>(100 * fraction);
  if (percent == drawn_percent_) return;
  drawn_percent_ = percent;
  const auto full = static_cast<std::size_t>(kCells * fraction);
  fmt::print(stderr, "\r[{:<{}}] {:3d} %", std::string(full, '#'), kCells, percent);
  std::fflush(stderr);
}

void ProgressBar::wipe() {
  if (drawn_percent_ >= 0) fmt::print(stderr, "\r{:<{}}\r", "", kCells + 9);
  drawn_percent_ = -1;
  std::fflush(stderr);
}

void ProgressBar::stop() {
  {
    const std::lock_guard lock(mutex_);
    ended_ = true;
  }
  wake_.notify_all();
  if (thread_.joinable()) thread_.join();
}

void ProgressBar::print(const std::string& line) {
  const std::lock_guard lock(mutex_);
  wipe();
  fmt::print(stderr, "{}\n", line);
}

Interruption::Interruption(Progress& progress) {
  interrupted_progress.store(&progress);
  for (const int number : {SIGINT, SIGTERM}) handle(number, true);
}

Interruption::~Interruption() {
  for (const int number : {SIGINT, SIGTERM}) handle(number, false);
  interrupted_progress.store(nullptr);
}

int Interruption::signal() noexcept { return received.load(); }

}  // namespace hexact::app
