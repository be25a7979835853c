// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "certificate_text.hpp"

#include <string>

namespace check {

// What refutes the claim `embedded`, or nothing: one oriented manifold, with or without boundary; planar; every facet a
// simple polygon, counter-clockwise about its normal; two facets meet in common vertices and edges alone; and, without
// a boundary, positive volume.
std::string embedded_fault(const Body& body);

}  // namespace check
