// SPDX-License-Identifier: LGPL-3.0-or-later
// The claim corner-cut-of: a body made from another by cutting all corners, or all edges, level by level.
#pragma once

#include "certificate_text.hpp"
#include "surface.hpp"

#include <functional>
#include <string>
#include <vector>

namespace check {

// Half-space i of `of` in the coordinates of `frame`.
Plane in_frame(const Body& of, std::size_t i, const Body& frame);

// The half-edge of each edge that runs to the vertex with the larger number, ascending: the order of edges.
std::vector<Index> edge_list(const Surface& s, const Edges& e);

// Steps from the surface `first`, the first of them making level `first_level`, up to the body: each level before the
// last has to be convex and cut off strictly where the next has planes, and loops and addresses of the last those of the
// body. `visit`, if any, sees each convex level before it is cut. What is wrong, or nothing.
std::string replay(const Body& body, const Surface& first, std::vector<Address> address, Index first_level,
                   const std::function<std::string(const Surface&, const Edges&)>& visit);

// What refutes that `body` comes from `base`, both being convex and over the same field; nothing when it does.
std::string corner_cut_fault(const Body& body, const Body& base, const std::string& name);

}  // namespace check
