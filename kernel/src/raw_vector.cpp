// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/kernel/raw_vector.hpp"

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <cstdlib>
#include <new>

namespace hexact {
namespace {

constexpr std::size_t kLargePage = std::size_t{1} << 21;

}  // namespace

void* allocate_array(std::size_t bytes) {
  const bool large = bytes >= 2 * kLargePage;
  void* const memory = large ? std::aligned_alloc(kLargePage, (bytes + kLargePage - 1) / kLargePage * kLargePage)
                             : std::malloc(bytes > 0 ? bytes : 1);
  if (memory == nullptr) throw std::bad_alloc();
#ifdef __linux__
  if (large) (void)madvise(memory, bytes, MADV_HUGEPAGE);  // a wish; without it only the speed differs
#endif
  return memory;
}

void free_array(void* memory) noexcept { std::free(memory); }

}  // namespace hexact
