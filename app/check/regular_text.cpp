// SPDX-License-Identifier: LGPL-3.0-or-later
// Reads the block `regular` of spectral certificates.
#include "regular.hpp"

namespace check {

RegularBlock read_regular(Scanner& in) {
  const auto word = [&](const std::string& expected) {
    if (in.word() != expected) in.fail("expected " + expected);
  };
  const auto small = [&](std::int64_t low, std::int64_t high) { return static_cast<int>(in.integer(low, high)); };
  const auto number = [&] { return in.number(in.word(), false).a; };
  constexpr int kMost = 64;
  RegularBlock block;
  block.continuity = small(0, kMost);
  word("directions");
  for (int n = small(0, kMost); n > 0; --n) {
    const int x = small(-kMost, kMost);
    block.directions.emplace_back(x, small(-kMost, kMost));
  }
  word("smoothing");
  for (int n = small(0, kMost); n > 0; --n) block.link.push_back(number());
  if (block.link.empty()) return block;
  word("growth"), block.low = number(), block.high = number();
  word("word");
  for (int n = small(0, 4); n > 0; --n) block.word.push_back(small(0, 1));
  word("vertices");
  int entries = 0;
  for (int n = small(0, kMost); n > 0; --n) {
    PolytopeVertex vertex;
    if (block.vertices.empty()) entries = small(0, kMost);
    else vertex.parent = small(0, kMost), vertex.digit = small(0, 1);
    for (int i = 0; i < entries; ++i) {
      const mpq_class x = number();
      if (x.get_den() != 1) in.fail("expected an integer");
      vertex.entries.push_back(x.get_num());
    }
    block.vertices.push_back(std::move(vertex));
  }
  word("images");
  for (int n = small(0, kMost); n > 0; --n) {
    PolytopeImage image;
    image.vertex = small(0, kMost), image.digit = small(0, 1);
    for (int m = small(0, kMost); m > 0; --m) {
      const int v = small(0, kMost);
      image.weights.emplace_back(v, number());
    }
    block.images.push_back(std::move(image));
  }
  return block;
}

}  // namespace check
