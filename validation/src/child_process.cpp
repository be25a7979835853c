// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/validation/child_process.hpp"

#include "hexact/kernel/errors.hpp"

#include <fcntl.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#ifdef __linux__
#include <sys/prctl.h>
#endif

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <system_error>
#include <thread>

namespace hexact::validation {
namespace {

constexpr rlim_t kLargestFile = rlim_t{1} << 30;
constexpr std::size_t kLongestOutput = std::size_t{1} << 20;

/// What the child does between fork and exec: only calls that are safe there. Reports errno through `failure`.
[[noreturn]] void become(char* const* arguments, const char* folder, const char* log, int failure) {
  setpgid(0, 0);
#ifdef __linux__
  prctl(PR_SET_PDEATHSIG, SIGKILL);
#endif
  const rlimit file_size{kLargestFile, kLargestFile};
  setrlimit(RLIMIT_FSIZE, &file_size);
  const int input = open("/dev/null", O_RDONLY);
  const int output = open(log, O_WRONLY | O_CREAT | O_TRUNC, 0600);
  if (input >= 0 && output >= 0 && chdir(folder) == 0 && dup2(input, 0) >= 0 && dup2(output, 1) >= 0 &&
      dup2(output, 2) >= 0) {
    execvp(arguments[0], arguments);
  }
  const int reason = errno;
  [[maybe_unused]] const auto written = write(failure, &reason, sizeof reason);
  _exit(127);
}

/// errno of a child that could not become the program; 0 when it could.
int start_failure(int pipe_end) {
  int reason = 0;
  ssize_t got = 0;
  do {
    got = read(pipe_end, &reason, sizeof reason);
  } while (got < 0 && errno == EINTR);
  return got == static_cast<ssize_t>(sizeof reason) ? reason : 0;
}

std::string beginning_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::string text(kLongestOutput, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(in.gcount(), 0)));
  return text;
}

/// Waits for our child; kills its group when the time is over.
void await(pid_t child, double seconds_limit, std::chrono::steady_clock::time_point start, const ProgressPart& progress,
           ChildResult& result) {
  const auto elapsed = [&] { return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(); };
  auto pause = std::chrono::milliseconds(1);
  bool killed = false;
  for (int status = 0;;) {
    const pid_t done = waitpid(child, &status, WNOHANG);
    if (done == child) {
      if (!killed) result.end = WIFEXITED(status) ? ChildResult::End::exited : ChildResult::End::signalled;
      result.status = WIFEXITED(status) ? WEXITSTATUS(status) : WTERMSIG(status);
      break;
    }
    if (done < 0 && errno != EINTR) break;
    if (!killed && (elapsed() > seconds_limit || progress.cancelled())) {
      killed = true;
      result.end = ChildResult::End::timed_out;
      if (kill(-child, SIGKILL) != 0) kill(child, SIGKILL);
    }
    std::this_thread::sleep_for(pause);
    pause = std::min(pause * 2, std::chrono::milliseconds(20));
  }
  result.seconds = elapsed();
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "hexact-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw FileError(std::string("cannot make a temporary folder: ") + std::strerror(errno), name);
  }
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(path_, ignored);
}

ChildResult run_child(const std::vector<std::string>& arguments, const std::filesystem::path& folder, double seconds_limit,
                      const ProgressPart& progress) {
  HEXACT_EXPECTS(!arguments.empty());
  ChildResult result;
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) {
    result.status = errno;
    return result;
  }
  std::vector<std::string> copies = arguments;
  std::vector<char*> pointers;
  for (std::string& a : copies) pointers.push_back(a.data());
  pointers.push_back(nullptr);
  const std::string where = folder.string(), log = (folder / "output.log").string();
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = fork();
  if (child == 0) become(pointers.data(), where.c_str(), log.c_str(), ends[1]);
  result.status = child < 0 ? errno : 0;
  close(ends[1]);
  if (child > 0) {
    setpgid(child, child);  // either of us may be first
    const int reason = start_failure(ends[0]);
    await(child, seconds_limit, start, progress, result);
    if (reason != 0) {
      result.end = ChildResult::End::not_started;
      result.status = reason;
    } else {
      result.output = beginning_of(folder / "output.log");
    }
  }
  close(ends[0]);
  progress.check();
  return result;
}

}  // namespace hexact::validation
