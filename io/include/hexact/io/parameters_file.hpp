// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/parameter_document.hpp"

#include <string>
#include <string_view>

namespace hexact::io {

/// Reads a JSON document of kind `parameters`:
/// {"hexact": "parameters", "version": 1, "default": POLICY,
///  "levels": [{"level": 0, "sizes": {"4": "1/4"}, "edges": [[a, b, "λab", "λba"]]}]}.
/// A number is a JSON number, read as the exact decimal it spells, or a string p, p/q or p/q+r/s*sqrt5.
/// Unknown keys are an error. Throws ParseError naming the path to what is wrong; `name` stands in messages.
[[nodiscard]] ParameterDocument parse_parameters(std::string_view bytes, const std::string& name);

/// The same from a file of at most 256 MiB, "-" being standard input. Throws FileError, ResourceLimit, ParseError.
[[nodiscard]] ParameterDocument read_parameters(const std::string& path);

}  // namespace hexact::io
