// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pds
{

/** \brief Counting sort whose two passes, over the same items, may run in several threads: count, begins, place.
 *
 * Which items are in a bucket depends on nothing else, but their order within it is left to chance: sort each bucket.
 */
class BucketSort
{
 public:
  explicit BucketSort(std::size_t buckets) : next_(buckets) {}

  void count(std::size_t bucket, std::uint32_t items = 1) { next_[bucket].fetch_add(items, std::memory_order_relaxed); }

  /** \brief Ends counting. \return where each bucket begins, and last, how many items there are */
  std::vector<std::size_t> begins()
  {
    std::vector<std::size_t> begin(next_.size() + 1);
    for (std::size_t b = 0; b < next_.size(); ++b) {
      begin[b + 1] = begin[b] + next_[b].load(std::memory_order_relaxed);
      next_[b].store(static_cast<std::uint32_t>(begin[b]), std::memory_order_relaxed);
    }
    return begin;
  }

  /** \brief The place of an item, or the first of those of several. */
  std::size_t place(std::size_t bucket, std::uint32_t items = 1)
  {
    return next_[bucket].fetch_add(items, std::memory_order_relaxed);
  }

 private:
  std::vector<std::atomic<std::uint32_t>> next_;  ///< 32 bits: all that is sorted here counts less than 2^32
};

}  // namespace pds
