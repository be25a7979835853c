// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/io/output_file.hpp"

#include "hexact/kernel/errors.hpp"

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <optional>
#include <sys/stat.h>
#include <unistd.h>

namespace hexact::io {
namespace {

[[noreturn]] void fail(const std::string& path, const char* action, int error) {
  throw FileError(std::string(action) + ": " + std::strerror(error), path);
}

/// Holds back SIGXFSZ and SIGPIPE of this thread while it writes, so that a full quota or a closed pipe is an error
/// code and not the end of the program. Signals that came meanwhile are taken away.
class WriteSignalsHeld {
 public:
  WriteSignalsHeld() {
    sigemptyset(&held_);
    sigaddset(&held_, SIGXFSZ);
    sigaddset(&held_, SIGPIPE);
    pthread_sigmask(SIG_BLOCK, &held_, &before_);
  }
  WriteSignalsHeld(const WriteSignalsHeld&) = delete;
  WriteSignalsHeld& operator=(const WriteSignalsHeld&) = delete;
  ~WriteSignalsHeld() {
    const timespec at_once{0, 0};
    while (sigtimedwait(&held_, nullptr, &at_once) > 0) {
    }
    pthread_sigmask(SIG_SETMASK, &before_, nullptr);
  }

 private:
  sigset_t held_{}, before_{};
};

std::string directory_of(const std::string& path) {
  const std::size_t slash = path.rfind('/');
  return slash == std::string::npos ? std::string() : path.substr(0, slash + 1);
}

/// Follows symlinks, also those to files that do not exist yet.
std::string follow_links(const std::string& path) {
  std::string target = path;
  constexpr int kLinks = 40;
  for (int i = 0; i < kLinks; ++i) {
    char buffer[4096];
    const ssize_t length = readlink(target.c_str(), buffer, sizeof(buffer));
    if (length < 0) return target;
    const std::string link(buffer, static_cast<std::size_t>(length));
    target = link.starts_with('/') ? link : directory_of(target) + link;
  }
  fail(path, "cannot be written", ELOOP);
}

/// A new file in the directory of the target, with a name that no other writer uses.
int create_beside(const std::string& target, std::string& temporary) {
  static std::atomic<unsigned> counter{0};
  constexpr int kTries = 100;
  for (int i = 0; i < kTries; ++i) {
    const std::string directory = directory_of(target);
    temporary = directory + "." + target.substr(directory.size()).substr(0, 200) + "." + std::to_string(getpid()) + "." +
                std::to_string(counter++) + ".tmp";
    const int descriptor = open(temporary.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0 || errno != EEXIST) return descriptor;
  }
  return -1;
}

}  // namespace

OutputFile::OutputFile(const std::string& path) : path_(path) {
  if (path == "-") {
    descriptor_ = STDOUT_FILENO;
    return;
  }
  if (path.empty()) fail(path, "cannot be written", ENOENT);
  struct stat status {};
  const bool exists = stat(path.c_str(), &status) == 0;
  if (!exists && errno != ENOENT) fail(path_, "cannot be written", errno);
  if (exists && S_ISDIR(status.st_mode)) fail(path_, "cannot be written", EISDIR);
  if (exists && !S_ISREG(status.st_mode)) {
    // By the given name: the link of a pipe in /proc/self/fd names no file ("pipe:[1234]").
    descriptor_ = open(path.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(path_, "cannot be opened for writing", errno);
    return;
  }
  target_ = follow_links(path);
  if (exists && access(target_.c_str(), W_OK) != 0) fail(path_, "cannot be written", errno);
  descriptor_ = create_beside(target_, temporary_);
  if (descriptor_ < 0) {
    temporary_.clear();
    fail(path_, "cannot be created", errno);
  }
  if (exists) (void)fchmod(descriptor_, status.st_mode & 07777);
}

OutputFile::~OutputFile() {
  if (descriptor_ > STDERR_FILENO) close(descriptor_);
  if (!committed_ && !temporary_.empty()) unlink(temporary_.c_str());
}

void OutputFile::write(std::string_view bytes) {
  const WriteSignalsHeld held;
  while (!bytes.empty()) {
    const ssize_t written = ::write(descriptor_, bytes.data(), bytes.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(path_, "cannot be written", errno);
    bytes.remove_prefix(static_cast<std::size_t>(written));
  }
}

void OutputFile::commit() {
  if (temporary_.empty()) {
    // Devices and pipes cannot always be synced; closing tells of late errors.
    if (descriptor_ > STDERR_FILENO) {
      const int result = close(descriptor_);
      descriptor_ = -1;
      if (result != 0) fail(path_, "cannot be written", errno);
    }
    committed_ = true;
    return;
  }
  if (fsync(descriptor_) != 0) fail(path_, "cannot be written", errno);
  const int result = close(descriptor_);
  descriptor_ = -1;
  if (result != 0) fail(path_, "cannot be written", errno);
  if (rename(temporary_.c_str(), target_.c_str()) != 0) fail(path_, "cannot be replaced", errno);
  committed_ = true;
  const std::string directory = directory_of(target_);
  const int parent = open(directory.empty() ? "." : directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (parent >= 0) {
    (void)fsync(parent);  // the name too is to survive a power cut; not every file system can
    close(parent);
  }
}

void write_file(const std::string& path, std::string_view bytes) {
  OutputFile file(path);
  file.write(bytes);
  file.commit();
}

}  // namespace hexact::io
