// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/point_array.h>

#include <algorithm>
#include <cstdint>
#include <mutex>
#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace pds
{

#if defined(__linux__)
namespace
{

constexpr std::size_t huge_page = std::size_t{1} << 21;  // bytes, on x86-64 and most ARM systems

bool is_large(std::size_t bytes) { return bytes >= 2 * huge_page; }

std::size_t whole_pages(std::size_t bytes) { return (bytes + huge_page - 1) / huge_page * huge_page; }

/** \brief Addresses at the border of a huge page, without memory behind them yet. */
char* reserve_addresses(std::size_t size)
{
  // One page more than needed, so that there is a place to begin at the border of a page; what is over goes back.
  void* reserved = mmap(nullptr, size + huge_page, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  if (reserved == MAP_FAILED) throw std::bad_alloc();
  char* const begin = static_cast<char*>(reserved);
  const std::size_t before = (huge_page - reinterpret_cast<std::uintptr_t>(begin) % huge_page) % huge_page;
  if (before > 0) munmap(begin, before);
  munmap(begin + before + size, huge_page - before);
  madvise(begin + before, size, MADV_HUGEPAGE);  // advice: where it is refused, small pages do
  return begin + before;
}

/** \brief Pages of arrays that are gone, for those that come. */
class PageStore
{
 public:
  void open()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    ++users_;
  }

  void close()
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (--users_ > 0) return;
    for (char* const page : pages_) munmap(page, huge_page);
    std::vector<char*>().swap(pages_);
  }

  /** \return false if nobody wants the pages */
  bool keep(char* begin, std::size_t size) noexcept
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (users_ == 0) return false;
    try {
      pages_.reserve(pages_.size() + size / huge_page);
    } catch (const std::bad_alloc&) {
      return false;
    }
    for (char* page = begin; page != begin + size; page += huge_page) pages_.push_back(page);
    return true;
  }

  /** \brief Brings as many pages as there are to addresses that have none, the first ones first. */
  void bring_to(char* begin, std::size_t size)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const std::size_t count = std::min(pages_.size(), size / huge_page);
    // Page by page, for a call cannot move what earlier calls have put together.
    for (auto page = pages_.end() - static_cast<std::ptrdiff_t>(count); page != pages_.end();
         ++page, begin += huge_page)
      bring_page(*page, begin);
    pages_.resize(pages_.size() - count);
  }

 private:
  static void bring_page(char* page, char* place)
  {
    if (mremap(page, huge_page, huge_page, MREMAP_MAYMOVE | MREMAP_FIXED, place) != MAP_FAILED) return;
    // The system has run out of something. The page is no loss, but the place must not stay a hole.
    munmap(page, huge_page);
    constexpr int protection = PROT_READ | PROT_WRITE;
    if (mmap(place, huge_page, protection, MAP_PRIVATE | MAP_ANONYMOUS | MAP_FIXED, -1, 0) == MAP_FAILED)
      throw std::bad_alloc();
  }

  std::mutex mutex_;
  unsigned users_ = 0;
  std::vector<char*> pages_;
};

PageStore& store()
{
  static PageStore pages;
  return pages;
}

}  // namespace

PageRecycling::PageRecycling() { store().open(); }

PageRecycling::~PageRecycling() { store().close(); }

void* allocate_large(std::size_t bytes)
{
  if (!is_large(bytes)) return ::operator new(bytes);
  if (bytes > SIZE_MAX - 2 * huge_page) throw std::bad_alloc();
  const std::size_t size = whole_pages(bytes);
  char* const memory = reserve_addresses(size);
  store().bring_to(memory, size);
  return memory;
}

void free_large(void* memory, std::size_t bytes) noexcept
{
  if (!is_large(bytes))
    ::operator delete(memory);
  else if (!store().keep(static_cast<char*>(memory), whole_pages(bytes)))
    munmap(memory, whole_pages(bytes));
}
#else
PageRecycling::PageRecycling() = default;

PageRecycling::~PageRecycling() = default;

void* allocate_large(std::size_t bytes) { return ::operator new(bytes); }

void free_large(void* memory, std::size_t) noexcept { ::operator delete(memory); }
#endif

}  // namespace pds
