// SPDX-License-Identifier: LGPL-3.0-or-later
// Reads the block `regular` of spectral certificates.
#include "regular.hpp"

namespace check {

RegularBlock read_regular(Scanner& in) {
  const auto line = [&](const std::string& expected) {
    in.next_line();
    if (in.word() != expected) in.fail("expected " + expected);
  };
  const auto small = [&](std::int64_t low, std::int64_t high) { return static_cast<int>(in.integer(low, high)); };
  const auto number = [&] { return in.number(in.word(), false).a; };
  constexpr int kMost = 64;
  RegularBlock block;
  block.continuity = small(0, kMost);
  line("directions");
  for (int n = small(0, kMost); n > 0; --n) {
    in.next_line();
    const int x = small(-kMost, kMost);
    block.directions.emplace_back(x, small(-kMost, kMost));
  }
  line("smoothing");
  for (int n = small(0, kMost); n > 0; --n) block.link.push_back(number());
  if (block.link.empty()) return block;
  line("growth"), block.low = number(), block.high = number();
  line("word");
  for (int n = small(0, 4); n > 0; --n) block.word.push_back(small(0, 1));
  line("vertices");
  int entries = 0;
  for (int n = small(0, kMost); n > 0; --n) {
    PolytopeVertex vertex;
    in.next_line();
    if (block.vertices.empty()) entries = small(0, kMost);
    else vertex.parent = small(0, kMost), vertex.digit = small(0, 1);
    for (int i = 0; i < entries; ++i) {
      const mpq_class x = number();
      if (x.get_den() != 1) in.fail("expected an integer");
      vertex.entries.push_back(x.get_num());
    }
    block.vertices.push_back(std::move(vertex));
  }
  line("images");
  for (int n = small(0, kMost); n > 0; --n) {
    PolytopeImage image;
    in.next_line();
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
