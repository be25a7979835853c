// SPDX-License-Identifier: GPL-3.0-or-later
// Measures Midedge refinement of the cube in doubles, topology and points of all levels:
// midedge_bench STEPS [six-point|simple] [THREADS]
#include "measure.hpp"

#include "hexact/kernel/midedge.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

using namespace hexact;

namespace {

MidedgeLevel<double> cube() {
  FacetLoops loops;
  for (const auto& loop : {std::initializer_list<int>{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}}) {
    for (const int v : loop) loops.add_corner(make_id<VertexId>(static_cast<std::size_t>(v)));
    loops.close_loop();
  }
  PointArray<double> points;
  for (int i = 0; i < 8; ++i) points.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
  return {MidedgeMap(loops, 8), points};
}

}  // namespace

int main(int argc, char** argv) {
  const int steps = argc > 1 ? std::atoi(argv[1]) : 0;
  const std::string rule = argc > 2 ? argv[2] : "six-point";
  if (steps < 1 || (rule != "six-point" && rule != "simple")) {
    std::fputs("usage: midedge_bench STEPS [six-point|simple] [THREADS]\n", stderr);
    return 2;
  }
  const int threads = argc > 3 ? std::atoi(argv[3]) : static_cast<int>(std::thread::hardware_concurrency());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  // The threads are started before: that is part of a process, not of its work.
  tbb::parallel_for(0, 64 * threads, [](int) { std::this_thread::yield(); });
  bench::Measure measure;
  MidedgeLevel<double> level = cube();
  for (int n = 0; n < steps; ++n) {
    level = midedge_step(level, rule == "simple" ? MidedgeRule::simple : MidedgeRule::six_point, MidedgeBoundary::close);
  }
  measure.stop();
  measure.print("hexact Midedge " + rule + " cube " + std::to_string(steps), level.map.facet_count(), threads);
  return 0;
}
