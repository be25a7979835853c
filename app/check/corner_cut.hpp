// SPDX-License-Identifier: LGPL-3.0-or-later
// The claim corner-cut-of: a body made from another by cutting all corners, or all edges, level by level.
#pragma once

#include "certificate_text.hpp"

#include <string>

namespace check {

// Half-space i of `of` in the coordinates of `frame`.
Plane in_frame(const Body& of, std::size_t i, const Body& frame);

// What refutes that `body` comes from `base`, both being convex and over the same field; nothing when it does.
std::string corner_cut_fault(const Body& body, const Body& base, const std::string& name);

}  // namespace check
