// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/kernel/edge_numbering.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

namespace hexact {

EdgeNumbering number_edges(const HoneycombMap& map) {
  EdgeNumbering numbers;
  const auto half_edges = static_cast<std::uint32_t>(map.half_edge_count());
  numbers.edge.resize(half_edges);
  numbers.half_edge.resize(map.edge_count());
  constexpr std::uint32_t kBlock = 1 << 14;
  const std::uint32_t blocks = (half_edges + kBlock - 1) / kBlock;
  const auto is_first = [&](std::uint32_t h) { return map.origin(h) < map.target(h); };
  const auto for_block = [&](std::uint32_t b, const auto& visit) {
    for (std::uint32_t h = b * kBlock; h < std::min(half_edges, (b + 1) * kBlock); ++h) {
      if (is_first(h)) visit(h);
    }
  };
  std::vector<std::uint32_t> start(blocks + 1, 0);
  tbb::parallel_for(std::uint32_t{0}, blocks, [&](std::uint32_t b) {
    std::uint32_t count = 0;
    for_block(b, [&](std::uint32_t) { ++count; });
    start[b + 1] = count;
  });
  for (std::uint32_t b = 0; b < blocks; ++b) start[b + 1] += start[b];
  tbb::parallel_for(std::uint32_t{0}, blocks, [&](std::uint32_t b) {
    std::uint32_t e = start[b];
    for_block(b, [&](std::uint32_t h) {
      numbers.edge[h] = numbers.edge[map.twin(h)] = e;
      numbers.half_edge[e++] = h;
    });
  });
  numbers.at_vertex.resize(map.vertex_count());
  const auto vertices = static_cast<std::uint32_t>(map.vertex_count());
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, vertices, kBlock), [&](const auto& range) {
    for (std::uint32_t v = range.begin(); v != range.end(); ++v) {
      const auto s = map.star(v);
      numbers.at_vertex[v] = {numbers.edge[s[0]], numbers.edge[s[1]], numbers.edge[s[2]]};
    }
  });
  return numbers;
}

}  // namespace hexact
