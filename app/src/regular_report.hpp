// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "hexact/exact/regular_smoothness.hpp"

#include <nlohmann/json.hpp>

#include <string>

namespace hexact::app {

/// The object `regular` of `hexact spectrum --regular --json`.
[[nodiscard]] nlohmann::ordered_json regular_json(const RegularSmoothness& regular);
/// The same for people.
[[nodiscard]] std::string regular_text(const RegularSmoothness& regular);

}  // namespace hexact::app
