// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace hexact::io {

/// Writes all bytes to `path`, whole or not at all: a temporary file beside the target is written, synced and
/// renamed over it. A symlink's target is replaced, not the link; devices and pipes are written through; "-" is
/// standard output. Throws FileError with the reason; no temporary file is left behind.
void write_file(const std::string& path, std::string_view bytes);

/// A temporary file beside its target that appears under its name only on `commit`; removed otherwise.
class OutputFile {
 public:
  explicit OutputFile(const std::string& path);
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();
  void write(std::string_view bytes);
  /// Flushes, syncs and renames. Throws FileError; the target is then untouched.
  void commit();

 private:
  std::string path_;       ///< as given, for messages
  std::string target_;     ///< after following symlinks
  std::string temporary_;  ///< empty when written through
  int descriptor_ = -1;
  bool committed_ = false;
};

}  // namespace hexact::io
