// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>

namespace pds
{

/** \brief The only place where threads are made: loops over index ranges, cut into blocks that workers take in turn.
 *
 * Which worker runs a block is left to chance, so a loop body may write only to what its indices own; every use in the
 * library keeps to that, which is why results do not depend on the number of threads.
 */
class Parallel
{
 public:
  /** \param threads workers; 0 = all cores */
  explicit Parallel(unsigned threads = 0);

  /** \brief Number of workers; a block's worker number is below it. */
  [[nodiscard]] unsigned threads() const { return threads_; }

  /** \brief Calls body(begin, end, worker) for blocks that cover 0 ... count - 1.
   *
   * Runs in the calling thread if there is only one block. The first exception of a body is rethrown here.
   * \param block indices per block; choose it so that a block takes well over the 20 microseconds a thread costs
   */
  void blocks(std::size_t count,
              std::size_t block,
              const std::function<void(std::size_t begin, std::size_t end, unsigned worker)>& body) const;

  /** \brief Calls body(i) for every i in 0 ... count - 1, in blocks of \a block indices. */
  template <typename Body>
  void each(std::size_t count, std::size_t block, const Body& body) const
  {
    blocks(count, block, [&body](std::size_t begin, std::size_t end, unsigned) {
      for (std::size_t i = begin; i < end; ++i) body(i);
    });
  }

 private:
  unsigned threads_;
};

}  // namespace pds
