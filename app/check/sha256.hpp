// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>

namespace check {

// The SHA-256 digest (FIPS 180-4) in hexadecimal.
std::string sha256(std::string_view bytes);

}  // namespace check
