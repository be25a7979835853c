// SPDX-License-Identifier: GPL-3.0-or-later
#include "hexact/io/output_file.hpp"

#include "hexact/kernel/errors.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace fs = std::filesystem;
using namespace hexact;

namespace {

/// A directory that goes away with its files.
struct Scratch {
  fs::path path = fs::temp_directory_path() / ("hexact-output-" + std::to_string(getpid()));
  Scratch() { fs::create_directories(path); }
  ~Scratch() { fs::remove_all(path); }
  [[nodiscard]] std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
  }
};

std::string content(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

/// A bound on file sizes for this process while it lives.
struct FileSizeLimit {
  rlimit before{};
  explicit FileSizeLimit(rlim_t bytes) {
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit limit{bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit() { setrlimit(RLIMIT_FSIZE, &before); }
};

}  // namespace

TEST_CASE("an output appears whole, and replaces what stood there", "[io]") {
  const Scratch scratch;
  const fs::path file = scratch.path / "out";
  io::write_file(file, "first");
  CHECK(content(file) == "first");
  chmod(file.c_str(), 0640);
  io::write_file(file, "second");
  CHECK(content(file) == "second");
  CHECK((fs::status(file).permissions() & fs::perms::all) == static_cast<fs::perms>(0640));
  CHECK(scratch.entries() == 1);
}

TEST_CASE("an output that is not committed leaves nothing", "[io]") {
  const Scratch scratch;
  const fs::path file = scratch.path / "out";
  io::write_file(file, "old");
  {
    io::OutputFile output(file);
    output.write("new");
    CHECK(content(file) == "old");
  }
  CHECK(content(file) == "old");
  CHECK(scratch.entries() == 1);
}

TEST_CASE("a symlink stays and its target is replaced", "[io]") {
  const Scratch scratch;
  fs::create_symlink("target", scratch.path / "link");
  io::write_file(scratch.path / "link", "new");
  CHECK(fs::is_symlink(scratch.path / "link"));
  CHECK(content(scratch.path / "target") == "new");
  fs::create_symlink("loop", scratch.path / "loop");
  CHECK_THROWS_AS(io::write_file(scratch.path / "loop", "new"), FileError);
}

TEST_CASE("pipes are written through, by whatever name they have", "[io]") {
  const Scratch scratch;
  int ends[2];
  REQUIRE(pipe(ends) == 0);
  const std::string number = std::to_string(ends[1]);
  fs::create_symlink("/proc/self/fd/" + number, scratch.path / "link");
  for (const std::string& name : {"/proc/self/fd/" + number, "/dev/fd/" + number, (scratch.path / "link").string()}) {
    io::write_file(name, "through");
    char bytes[16];
    const ssize_t length = read(ends[0], bytes, sizeof(bytes));
    CHECK(std::string(bytes, static_cast<std::size_t>(std::max<ssize_t>(length, 0))) == "through");
  }
  close(ends[0]);
  CHECK_THROWS_AS(io::write_file("/dev/fd/" + number, "nobody reads"), FileError);
  close(ends[1]);
  CHECK(scratch.entries() == 1);
}

TEST_CASE("a full disk, a full device and impossible places are file errors", "[io]") {
  const Scratch scratch;
  const fs::path file = scratch.path / "out";
  io::write_file(file, "old");
  {
    const FileSizeLimit limit(4096);
    CHECK_THROWS_AS(io::write_file(file, std::string(10000, 'x')), FileError);
  }
  CHECK(content(file) == "old");
  CHECK_THROWS_AS(io::write_file("/dev/full", "x"), FileError);
  CHECK(fs::is_character_file("/dev/full"));
  CHECK_THROWS_AS(io::write_file(file / "below", "x"), FileError);
  CHECK_THROWS_AS(io::write_file(scratch.path, "x"), FileError);
  CHECK_THROWS_AS(io::write_file(scratch.path / "missing" / "x", "x"), FileError);
  CHECK(scratch.entries() == 1);
}
