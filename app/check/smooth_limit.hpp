// SPDX-License-Identifier: LGPL-3.0-or-later
// The claim smooth-limit: the last levels are chamfer steps whose lifts keep the budgets of docs/smooth-limit.md.
#pragma once

#include "certificate_text.hpp"

#include <string>

namespace check {

// Why the claim is not proved for this body, which is convex; nothing when it is. A gap refutes nothing.
std::string smooth_limit_gap(const Body& body);

}  // namespace check
