// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

namespace pds
{

/** \brief Memory for large arrays, in huge pages where the system has them: a page fault per 4 KiB would cost a tenth
 * of a run. */
[[nodiscard]] void* allocate_large(std::size_t bytes);
/** \param bytes as many as were asked for */
void free_large(void* memory, std::size_t bytes) noexcept;

/** \brief Gives an array of values of the points memory from allocate_large(), and does not clear what has no default
 * value: each thread writes its part first. */
template <typename T>
struct PointAllocator
{
  using value_type = T;

  PointAllocator() = default;
  template <typename U>
  PointAllocator(const PointAllocator<U>&)  // NOLINT(google-explicit-constructor): allocators convert
  {
  }

  [[nodiscard]] T* allocate(std::size_t n)
  {
    if (n > static_cast<std::size_t>(-1) / sizeof(T)) throw std::bad_alloc();
    return static_cast<T*>(allocate_large(n * sizeof(T)));
  }
  void deallocate(T* memory, std::size_t n) noexcept { free_large(memory, n * sizeof(T)); }

  template <typename U>
  void construct(U* place)
  {
    ::new (static_cast<void*>(place)) U;
  }
  template <typename U, typename... Arguments>
  void construct(U* place, Arguments&&... arguments)
  {
    ::new (static_cast<void*>(place)) U(std::forward<Arguments>(arguments)...);
  }

  bool operator==(const PointAllocator&) const { return true; }
  bool operator!=(const PointAllocator&) const { return false; }
};

/** \brief One value, or one row of values, for each point. PointArray<T>(n) and resize() leave plain values unset. */
template <typename T>
using PointArray = std::vector<T, PointAllocator<T>>;

}  // namespace pds
