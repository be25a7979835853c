// SPDX-License-Identifier: LGPL-3.0-or-later
#include "hexact/kernel/raw_vector.hpp"

#ifdef __linux__
#include <sys/mman.h>
#endif

#include <cstdint>
#include <cstdlib>
#include <new>

namespace hexact {
namespace {

#ifdef __linux__
constexpr std::size_t kLargePage = std::size_t{1} << 21;
constexpr std::size_t kLargeArray = 2 * kLargePage;

/// Whole pages of the smaller size.
std::size_t mapped_size(std::size_t bytes) { return (bytes + 4095) / 4096 * 4096; }
#endif

}  // namespace

#ifdef __linux__

// Large arrays are mapped on their own, so that what is freed goes back to the system at once: the heap would keep it.
void* allocate_array(std::size_t bytes) {
  if (bytes < kLargeArray) {
    if (void* const memory = std::malloc(bytes > 0 ? bytes : 1)) return memory;
    throw std::bad_alloc();
  }
  const std::size_t wanted = mapped_size(bytes), padded = wanted + kLargePage;
  void* const mapped = mmap(nullptr, padded, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (mapped == MAP_FAILED) throw std::bad_alloc();
  char* const begin = static_cast<char*>(mapped);
  const std::size_t skip = (kLargePage - reinterpret_cast<std::uintptr_t>(begin) % kLargePage) % kLargePage;
  if (skip > 0) (void)munmap(begin, skip);
  if (padded > skip + wanted) (void)munmap(begin + skip + wanted, padded - skip - wanted);
  (void)madvise(begin + skip, wanted, MADV_HUGEPAGE);  // a wish; without it only the speed differs
  return begin + skip;
}

void free_array(void* memory, std::size_t bytes) noexcept {
  if (bytes < kLargeArray) {
    std::free(memory);
  } else {
    (void)munmap(memory, mapped_size(bytes));
  }
}

#else

void* allocate_array(std::size_t bytes) {
  if (void* const memory = std::malloc(bytes > 0 ? bytes : 1)) return memory;
  throw std::bad_alloc();
}

void free_array(void* memory, std::size_t) noexcept { std::free(memory); }

#endif

}  // namespace hexact
