// SPDX-License-Identifier: GPL-3.0-or-later
// Measures the chamfer engine, lifts by the default rule and all conditions decided: chamfer_bench SHAPE LEVEL [THREADS]
#include "measure.hpp"
#include "sample_bodies.hpp"

#include "hexact/exact/lift_rules.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

using namespace hexact;

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("usage: chamfer_bench cube|tetrahedron|generic LEVEL [THREADS]\n", stderr);
    return 2;
  }
  const std::string shape = argv[1];
  const int levels = std::atoi(argv[2]);
  const int threads = argc > 3 ? std::max(1, std::atoi(argv[3])) : static_cast<int>(std::thread::hardware_concurrency());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  ChamferLevel level = chamfer_start(bench::base_of(shape));
  // The threads are started before: that is part of a process, not of its work.
  tbb::parallel_for(0, 64 * threads, [](int) { std::this_thread::yield(); });
  bench::Measure measure;
  const LiftRule rule = automatic_lifts(constant_keep(0.5));
  for (int l = 1; l <= levels; ++l) level = chamfer_step(std::move(level), rule);
  measure.stop();
  measure.print("hexact chamfer " + shape + " " + std::to_string(levels), level.surface.map.facet_count(), threads);
  return 0;
}
