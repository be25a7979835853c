// SPDX-License-Identifier: GPL-3.0-or-later
// Measures the snapped engine, signs of the certificate included, and the engine in doubles:
// honeycomb_bench SHAPE LEVEL [snapped|double] [THREADS]
#include "measure.hpp"
#include "sample_bodies.hpp"

#include "hexact/exact/snapped_honeycomb.hpp"
#include "hexact/kernel/honeycomb_double.hpp"

#include <tbb/global_control.h>
#include <tbb/parallel_for.h>

#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

using namespace hexact;

namespace {

/// Planes, map and all signs of the certificate of each level; returns the number of facets, 0 after a refusal.
std::size_t run_snapped(SnappedLevel level, int levels) {
  const CutPolicy policy = static_policy_rational();
  for (int l = 1; l <= levels; ++l) {
    level = snapped_step(std::move(level), policy, {}).level;
    if (const auto bad = sign_violations(level); !bad.empty()) {
      const Finding f = explain(bad.front(), level.map);
      std::fprintf(stderr, "%s: %s %s\n", f.code.c_str(), f.element.c_str(), f.message.c_str());
      return 0;
    }
  }
  return level.map.facet_count();
}

/// Points and map in plain doubles, the static parameters rounded.
std::size_t run_double(DoubleLevel level, int levels) {
  SizeTable table;
  for (const QuadraticField& beta : static_policy_rational().by_size) table.push_back(beta.to_double());
  for (int l = 1; l <= levels; ++l) level = double_step(std::move(level), table);
  return level.map.facet_count();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("usage: honeycomb_bench cube|tetrahedron|generic LEVEL [snapped|double] [THREADS]\n", stderr);
    return 2;
  }
  const std::string shape = argv[1];
  const int levels = std::atoi(argv[2]);
  const std::string engine = argc > 3 && std::atoi(argv[3]) == 0 ? argv[3] : "snapped";
  const int asked = std::atoi(argv[argc - 1]);
  const int threads = argc > 3 && asked > 0 ? asked : static_cast<int>(std::thread::hardware_concurrency());
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  SnappedLevel start = snapped_start(bench::base_of(shape));
  // The threads are started before: that is part of a process, not of its work.
  tbb::parallel_for(0, 64 * threads, [](int) { std::this_thread::yield(); });
  bench::Measure measure;
  const std::size_t facets = engine == "double" ? run_double(DoubleLevel{start.map, start.points}, levels)
                                                : run_snapped(std::move(start), levels);
  measure.stop();
  if (facets == 0) return 1;
  measure.print("hexact " + engine + " " + shape + " " + std::to_string(levels), facets, threads);
  return 0;
}
