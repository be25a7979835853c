// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes are either geometry or one of our errors. What is accepted can be written and reads back as the same.
#include "hexact/io/mesh_file.hpp"
#include "hexact/kernel/errors.hpp"

#include <cstdint>
#include <cstdlib>
#include <string>

using namespace hexact;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr io::Format kFormat = io::Format::HEXACT_FUZZ_FORMAT;
  std::string bytes(reinterpret_cast<const char*>(data), size);
  if (kFormat == io::Format::certificate) {
    // Without its digest nothing behind the reader's first lines would ever be reached.
    const std::string digest = io::sha256_hex(bytes);
    bytes += "sha256 " + digest + "\n";
  }
  try {
    const io::Geometry geometry = io::parse_geometry(bytes, kFormat, "fuzz");
    if (const auto* body = std::get_if<PlaneBody>(&geometry)) {
      const std::string text = io::planes_text(*body);
      if (io::planes_text(std::get<PlaneBody>(io::parse_geometry(text, kFormat, "fuzz"))) != text) std::abort();
    } else if (const auto* certificate = std::get_if<Certificate>(&geometry)) {
      const std::string text = io::certificate_text(*certificate);
      const auto again = std::get<Certificate>(io::parse_geometry(text, kFormat, "fuzz"));
      if (io::certificate_text(again) != text) std::abort();
    }
  } catch (const Error&) {
  }
  return 0;
}
