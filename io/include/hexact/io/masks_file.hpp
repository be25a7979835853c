// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/spectrum_masks.hpp"

#include <string>
#include <string_view>

namespace hexact::io {

/// Reads a `masks` document: `{"hexact": "masks", "version": 1, "name", "scheme"?, "masks": [{"valence", "weights" or
/// "blocks"}]}`. Numbers are exact: a JSON number as the decimal it spells, or a string "p/q". Unknown keys are errors.
/// Throws ParseError with the path to what is wrong.
[[nodiscard]] MasksDocument parse_masks(std::string_view bytes, const std::string& name);
/// The same from a file, "-" being standard input. Throws FileError, ResourceLimit (more than 256 MiB) too.
[[nodiscard]] MasksDocument read_masks(const std::string& path);

}  // namespace hexact::io
