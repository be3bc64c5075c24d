// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/point_array.h>

#if defined(__linux__)
#include <sys/mman.h>
#include <cstdint>
#include "page_pool.h"
#endif

namespace pds
{

#if defined(__linux__)
namespace
{

bool is_large(std::size_t bytes) { return bytes >= 2 * huge_page; }

std::size_t whole_pages(std::size_t bytes) { return (bytes + huge_page - 1) / huge_page * huge_page; }

}  // namespace

void* allocate_large(std::size_t bytes)
{
  if (!is_large(bytes)) return ::operator new(bytes);
  if (bytes > SIZE_MAX - 2 * huge_page) throw std::bad_alloc();
  // One page more than needed, so that there is a place to begin at the border of a page; what is over goes back.
  const std::size_t size = whole_pages(bytes);
  void* reserved = mmap(nullptr, size + huge_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (reserved == MAP_FAILED) throw std::bad_alloc();
  char* const begin = static_cast<char*>(reserved);
  const std::size_t before = (huge_page - reinterpret_cast<std::uintptr_t>(begin) % huge_page) % huge_page;
  if (before > 0) munmap(begin, before);
  munmap(begin + before + size, huge_page - before);
  madvise(begin + before, size, MADV_HUGEPAGE);  // advice: where it is refused, small pages do
  page_pool().move_pages_to(begin + before, size);
  return begin + before;
}

void free_large(void* memory, std::size_t bytes) noexcept
{
  if (!is_large(bytes))
    ::operator delete(memory);
  else if (!page_pool().put(static_cast<char*>(memory), whole_pages(bytes)))
    munmap(memory, whole_pages(bytes));
}
#else
void* allocate_large(std::size_t bytes) { return ::operator new(bytes); }

void free_large(void* memory, std::size_t) noexcept { ::operator delete(memory); }
#endif

}  // namespace pds
