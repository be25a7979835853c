// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace hexact {

/// Memory of at least `bytes` bytes, in large pages where the system has them and `bytes` is worth it: an array of a
/// million facets then costs a few page faults instead of tens of thousands. Throws std::bad_alloc.
[[nodiscard]] void* allocate_array(std::size_t bytes);
void free_array(void* memory, std::size_t bytes) noexcept;

/// Leaves new elements of `resize` without a value: large arrays are then touched first by the threads that fill
/// them, instead of being zeroed by one. Only for types that may live without a constructor having run.
template <class T>
class UninitializedAllocator : public std::allocator<T> {
 public:
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);
  template <class U>
  struct rebind {
    using other = UninitializedAllocator<U>;
  };
  UninitializedAllocator() = default;
  template <class U>
  UninitializedAllocator(const UninitializedAllocator<U>&) noexcept {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] T* allocate(std::size_t n) { return static_cast<T*>(allocate_array(n * sizeof(T))); }
  void deallocate(T* memory, std::size_t n) noexcept { free_array(memory, n * sizeof(T)); }

  template <class U>
  void construct(U*) const noexcept {}
  template <class U, class... Arguments>
  void construct(U* place, Arguments&&... arguments) const {
    std::construct_at(place, std::forward<Arguments>(arguments)...);
  }
};

/// A vector whose `resize` leaves new elements unset; every one of them has to be written before it is read.
template <class T>
using RawVector = std::vector<T, UninitializedAllocator<T>>;

}  // namespace hexact
