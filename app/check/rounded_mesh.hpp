// SPDX-License-Identifier: LGPL-3.0-or-later
// A mesh of rounded coordinates (OBJ or OFF), and whether it is the correct rounding of an exact body.
#pragma once

#include "certificate_text.hpp"

#include <array>
#include <string>
#include <string_view>
#include <vector>

namespace check {

struct Mesh {
  std::vector<std::array<double, 3>> points;
  std::vector<std::vector<Index>> loops;
};

// Throws Malformed.
Mesh read_mesh(const std::string& path);
Mesh parse_mesh(std::string_view bytes, const std::string& name);

// What is wrong, or nothing: the same loops in the same order, each coordinate the double nearest to the exact one,
// ties to even.
std::string rounding_fault(const Body& body, const Mesh& mesh);

}  // namespace check
