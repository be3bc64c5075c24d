// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/point_array.h>

#include <cstdlib>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace pds
{

void* allocate_large(std::size_t bytes)
{
  constexpr std::size_t huge_page = std::size_t{1} << 21;  // bytes, on x86-64 and most ARM systems
  const bool large = bytes >= 2 * huge_page;
  void* memory = large ? std::aligned_alloc(huge_page, (bytes + huge_page - 1) / huge_page * huge_page)
                       : std::malloc(bytes > 0 ? bytes : 1);
  if (memory == nullptr) throw std::bad_alloc();
#if defined(MADV_HUGEPAGE)
  if (large) madvise(memory, bytes, MADV_HUGEPAGE);  // advice: where it is refused, small pages do
#endif
  return memory;
}

void free_large(void* memory) noexcept { std::free(memory); }

}  // namespace pds
