// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <mutex>
#include <vector>

namespace pds
{

constexpr std::size_t huge_page = std::size_t{1} << 21;  // bytes, on x86-64 and most ARM systems

/** \brief Huge pages of arrays that were freed, for the next arrays: the system clears every page before it hands it
 * out, which would take a tenth of a run.
 *
 * Arrays of whatever size take pages from here first, so that there are hardly more of them than without. Pages are
 * moved, not copied: only the system's tables change. All may be called from several threads. Linux only.
 */
class PagePool
{
 public:
  void begin_use();

  /** \brief With the last one that is ended, all pages go back to the system. */
  void end_use();

  /** \brief Takes over the memory of an array.
   * \param begin at the border of a page \param size whole pages
   * \return false if nobody uses the pool, or too much is in it: the memory is still the caller's */
  [[nodiscard]] bool put(char* begin, std::size_t size) noexcept;

  /** \brief Puts pages, as far as there are any, in the place of those of an array that was not written to yet. */
  void move_pages_to(char* begin, std::size_t size) noexcept;

 private:
  /** \brief Null if there is none. */
  char* take_page() noexcept;

  std::mutex mutex_;
  unsigned users_ = 0;
  std::vector<char*> pages_;  ///< each still at its address; the last one is taken first
};

/** \brief The pool of all arrays. */
PagePool& page_pool();

/** \brief While one exists, the pool of all arrays is in use. */
class PageReuse
{
 public:
  PageReuse() { page_pool().begin_use(); }
  ~PageReuse() { page_pool().end_use(); }
  PageReuse(const PageReuse&) = delete;
  PageReuse& operator=(const PageReuse&) = delete;
};

}  // namespace pds
