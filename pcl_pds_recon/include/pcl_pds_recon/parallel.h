// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace pds
{

/** \brief The only place where threads are made: loops over index ranges, cut into blocks that workers take in turn.
 *
 * Which worker runs a block is left to chance, so a loop body may write only to what its indices own; every use in the
 * library keeps to that, which is why results do not depend on the number of threads. The threads are made by the first
 * loop that has work for them and sleep between loops; copies share them.
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
   * Runs in the calling thread if there is only one block, or if the workers are busy: with a loop that this one is
   * part of, or with one that another thread started. The first exception of a body is rethrown here.
   * \param block indices per block; choose it so that a block takes well over the 20 microseconds in which a worker
   * wakes up
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

  /** \brief Adds up part(begin, end) of all blocks, with += and in the order of the blocks: rounding, too, is the same
   * for any number of threads. */
  template <typename Part>
  auto sum(std::size_t count, std::size_t block, const Part& part) const
  {
    using Sum = decltype(part(count, count));
    std::vector<Sum> parts((count + block - 1) / block);
    blocks(count, block,
           [&](std::size_t begin, std::size_t end, unsigned) { parts[begin / block] = part(begin, end); });
    Sum total{};
    for (const Sum& p : parts) total += p;
    return total;
  }

 private:
  class Team;

  unsigned threads_;
  std::shared_ptr<Team> team_;  ///< the workers beside the calling thread, shared by copies; none if there is only one
};

}  // namespace pds
