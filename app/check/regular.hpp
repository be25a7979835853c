// SPDX-License-Identifier: LGPL-3.0-or-later
// The block `regular` of spectral certificates: how smooth limits are where the mesh is regular. What is proved, and
// why it suffices, is in docs/regular-smoothness.md.
#pragma once

#include "certificate_text.hpp"

#include <string>
#include <utility>
#include <vector>

namespace check {

enum class Scheme;

struct PolytopeVertex {
  int parent = 0, digit = 0;  // of the first vertex unused
  std::vector<mpz_class> entries;
};
struct PolytopeImage {
  int vertex = 0, digit = 0;
  std::vector<std::pair<int, mpq_class>> weights;
};
struct RegularBlock {
  int continuity = 0;
  std::vector<std::pair<int, int>> directions;
  std::vector<mpq_class> link;  // empty: nothing of what follows is there
  mpq_class low, high;
  std::vector<int> word;
  std::vector<PolytopeVertex> vertices;
  std::vector<PolytopeImage> images;
};

// Reads the block behind its first word. Throws Malformed.
RegularBlock read_regular(Scanner& in);
// What is wrong with the proof; empty if nothing is.
std::string regular_fault(Scheme scheme, const RegularBlock& block);

}  // namespace check
