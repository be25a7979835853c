// SPDX-License-Identifier: GPL-3.0-or-later
// Any bytes are a JSON document of some kind or one of our errors. Masks that are accepted are matrices or refused.
#include "hexact/io/lifts_file.hpp"
#include "hexact/io/masks_file.hpp"
#include "hexact/io/parameters_file.hpp"
#include "hexact/kernel/errors.hpp"

#include <cstdint>
#include <string>

using namespace hexact;

namespace {

template <class Read>
void attempt(const Read& read) {
  try {
    read();
  } catch (const Error&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  attempt([&] { (void)io::parse_lifts(bytes, "fuzz"); });
  attempt([&] { (void)io::parse_parameters(bytes, "fuzz"); });
  attempt([&] {
    const MasksDocument masks = io::parse_masks(bytes, "fuzz");
    constexpr int kLargest = 12;  // matrices of greater valences take time and show nothing new
    for (const ExtraordinaryMask& mask : masks.masks) {
      if (mask.valence <= kLargest) (void)mask_subject(masks, mask);
    }
  });
  return 0;
}
