// SPDX-License-Identifier: BSD-3-Clause
#include "page_pool.h"

#include <new>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace pds
{

void PagePool::begin_use()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  ++users_;
}

#if defined(__linux__)
void PagePool::end_use()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (--users_ > 0) return;
  for (char* page : pages_) munmap(page, huge_page);
  pages_ = {};
}

bool PagePool::put(char* begin, std::size_t size) noexcept
{
  // A page that was moved is a mapping by itself, of which Linux allows a process 65,530.
  constexpr std::size_t most_pages = 8192;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (users_ == 0 || pages_.size() + size / huge_page > most_pages) return false;
  try {
    pages_.reserve(most_pages);
  } catch (const std::bad_alloc&) {
    return false;
  }
  for (std::size_t end = size; end > 0; end -= huge_page) pages_.push_back(begin + end - huge_page);
  return true;
}

void PagePool::move_pages_to(char* begin, std::size_t size) noexcept
{
  for (char* const end = begin + size; begin < end; begin += huge_page) {
    char* const page = take_page();
    if (page == nullptr) return;
    // If it fails, there is memory at begin all the same: it is refused before anything changes.
    if (mremap(page, huge_page, huge_page, MREMAP_MAYMOVE | MREMAP_FIXED, begin) == MAP_FAILED) munmap(page, huge_page);
  }
}

char* PagePool::take_page() noexcept
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (pages_.empty()) return nullptr;
  char* const page = pages_.back();
  pages_.pop_back();
  return page;
}
#else
void PagePool::end_use() {}

bool PagePool::put(char*, std::size_t) noexcept { return false; }

void PagePool::move_pages_to(char*, std::size_t) noexcept {}
#endif

PagePool& page_pool()
{
  static PagePool pool;
  return pool;
}

}  // namespace pds
