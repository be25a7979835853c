// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/kernel/parallel.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace hexact {

void for_ranges(std::size_t count, std::size_t grain, const std::function<void(std::uint32_t, std::uint32_t)>& work) {
  if (count == 0) return;
  const auto last = static_cast<std::uint32_t>(count);
  if (count <= grain) return work(0, last);
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, last, grain),
                    [&](const tbb::blocked_range<std::uint32_t>& range) { work(range.begin(), range.end()); });
}

}  // namespace hexact
