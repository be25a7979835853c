// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/lift_document.hpp"

#include <string>
#include <string_view>

namespace hexact::io {

/// Reads a JSON document of kind `lifts`:
/// {"hexact": "lifts", "version": 1, "default": "auto", "factors": [κ, …],
///  "levels": [{"level": 0, "edges": [[a, b, τ], …]}, {"level": 1, "lifts": [τ, …]}]}.
/// A number is a JSON number, read as the exact decimal it spells, or a string p or p/q; unknown keys are an error.
/// Throws ParseError naming the path to what is wrong; `name` stands in messages.
[[nodiscard]] LiftDocument parse_lifts(std::string_view bytes, const std::string& name);

/// The same from a file of at most 256 MiB, "-" being standard input. Throws FileError, ResourceLimit, ParseError.
[[nodiscard]] LiftDocument read_lifts(const std::string& path);

}  // namespace hexact::io
