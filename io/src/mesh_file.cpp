// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/io/mesh_file.hpp"

#include "readers.hpp"

#include "hexact/io/output_file.hpp"
#include "hexact/kernel/errors.hpp"

#include <array>
#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace hexact::io {
namespace {

/// Closes on the way out; standard input stays open.
class InputDescriptor {
 public:
  explicit InputDescriptor(const std::string& path)
      : value_(path == "-" ? STDIN_FILENO : open(path.c_str(), O_RDONLY | O_CLOEXEC)) {}
  InputDescriptor(const InputDescriptor&) = delete;
  InputDescriptor& operator=(const InputDescriptor&) = delete;
  ~InputDescriptor() {
    if (value_ > STDERR_FILENO) close(value_);
  }
  [[nodiscard]] int value() const noexcept { return value_; }

 private:
  int value_;
};

std::string read_bytes(const std::string& path) {
  const InputDescriptor descriptor(path);
  if (descriptor.value() < 0) throw FileError(std::string("cannot be opened: ") + std::strerror(errno), path);
  struct stat status {};
  if (fstat(descriptor.value(), &status) == 0 && S_ISDIR(status.st_mode)) {
    throw FileError("cannot be read: it is a directory", path);
  }
  std::string bytes;
  constexpr std::size_t kChunk = std::size_t{1} << 16;
  std::size_t used = 0;
  bytes.resize(S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) + 1 : kChunk);
  while (true) {
    if (used == bytes.size()) bytes.resize(2 * bytes.size());
    const ssize_t got = read(descriptor.value(), bytes.data() + used, bytes.size() - used);
    if (got < 0 && errno == EINTR) continue;
    if (got < 0) throw FileError(std::string("cannot be read: ") + std::strerror(errno), path);
    if (got == 0) break;
    used += static_cast<std::size_t>(got);
  }
  bytes.resize(used);
  return bytes;
}

/// What the first bytes of a file tell; these beginnings belong to one format only.
std::optional<Format> format_from_magic(std::string_view bytes) {
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  constexpr std::array<std::pair<std::string_view, Format>, 8> kMagic = {{{"hexact-planes", Format::planes},
                                                                          {"hexact-certificate", Format::certificate},
                                                                          {"ply\n", Format::ply},
                                                                          {"ply\r", Format::ply},
                                                                          {"OFF", Format::off},
                                                                          {"COFF", Format::off},
                                                                          {"NOFF", Format::off},
                                                                          {"CNOFF", Format::off}}};
  for (const auto& [magic, format] : kMagic) {
    if (bytes.starts_with(magic)) return format;
  }
  return std::nullopt;
}

Format detect(std::string_view bytes, const std::string& path) {
  if (const auto format = format_from_magic(bytes)) return *format;
  if (const auto format = format_from_path(path)) return *format;
  if (bytes.starts_with("solid") || is_binary_stl(bytes)) return Format::stl;
  for (const char* start : {"v ", "o ", "g ", "mtllib "}) {
    if (bytes.starts_with(start) || bytes.find(std::string("\n") + start) < 4096) return Format::obj;
  }
  throw ParseError("neither the first bytes nor the name tell the format; say it with --from", path, 1);
}

}  // namespace

std::optional<Format> format_from_name(std::string_view name) {
  constexpr std::array<std::pair<std::string_view, Format>, 10> kNames = {{{"obj", Format::obj},
                                                                          {"off", Format::off},
                                                                          {"ply", Format::ply},
                                                                          {"ply-ascii", Format::ply_ascii},
                                                                          {"ply-float", Format::ply_float},
                                                                          {"stl", Format::stl},
                                                                          {"stl-ascii", Format::stl_ascii},
                                                                          {"planes", Format::planes},
                                                                          {"cert", Format::certificate},
                                                                          {"scad", Format::scad}}};
  for (const auto& [known, format] : kNames) {
    if (name == known) return format;
  }
  return std::nullopt;
}

std::optional<Format> format_from_path(std::string_view path) {
  const std::size_t dot = path.rfind('.');
  if (dot == std::string_view::npos || path.find('/', dot) != std::string_view::npos) return std::nullopt;
  std::string ending(path.substr(dot + 1));
  for (char& c : ending) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  if (ending == "hxc") return Format::certificate;
  return format_from_name(ending);
}

FloatFormat coordinate_format(Format format) noexcept {
  return format == Format::stl || format == Format::ply_float ? FloatFormat::binary32 : FloatFormat::binary64;
}

Geometry parse_geometry(std::string_view bytes, Format format, const std::string& name) {
  if (bytes.empty()) throw ParseError("the file is empty", name, 1);
  switch (format) {
    case Format::obj: return parse_obj(bytes, name);
    case Format::off: return parse_off(bytes, name);
    case Format::ply:
    case Format::ply_ascii:
    case Format::ply_float: return parse_ply(bytes, name);
    case Format::stl:
    case Format::stl_ascii: return parse_stl(bytes, name);
    case Format::planes: return parse_planes(bytes, name);
    case Format::certificate: return parse_certificate(bytes, name);
    case Format::scad: break;
  }
  throw ParseError("OpenSCAD programs can be written, not read", name, std::nullopt);
}

Geometry read_geometry(const std::string& path, std::optional<Format> format) {
  const std::string bytes = read_bytes(path);
  if (bytes.empty()) throw ParseError("the file is empty", path, 1);
  return parse_geometry(bytes, format ? *format : detect(bytes, path), path);
}

void write_mesh(const std::string& path, Format format, const MeshView& mesh, const MeshWriteOptions& options) {
  write_file(path, mesh_text(format, mesh, options));
}

void write_planes(const std::string& path, const PlaneBody& body) { write_file(path, planes_text(body)); }

void write_certificate(const std::string& path, const Certificate& certificate) {
  write_file(path, certificate_text(certificate));
}

}  // namespace hexact::io
