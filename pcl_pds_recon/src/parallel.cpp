// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/parallel.h>
#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace pds
{

Parallel::Parallel(unsigned threads)
    : threads_(threads != 0 ? threads : std::max(1U, std::thread::hardware_concurrency()))
{
}

void Parallel::blocks(std::size_t count,
                      std::size_t block,
                      const std::function<void(std::size_t, std::size_t, unsigned)>& body) const
{
  const std::size_t block_count = (count + block - 1) / block;
  const auto workers = static_cast<unsigned>(std::min<std::size_t>(threads_, block_count));
  std::atomic<std::size_t> next_block{0};
  std::exception_ptr first_exception;
  std::mutex exception_mutex;
  const auto work = [&](unsigned worker) {
    try {
      for (std::size_t b = next_block++; b < block_count; b = next_block++)
        body(b * block, std::min(count, (b + 1) * block), worker);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(exception_mutex);
      if (!first_exception) first_exception = std::current_exception();
      next_block = block_count;
    }
  };
  std::vector<std::thread> others;
  try {
    others.reserve(workers);
    for (unsigned worker = 1; worker < workers; ++worker) others.emplace_back(work, worker);
  } catch (...) {
    // No more threads, or no memory for them: those there are do all the work.
  }
  work(0);
  for (std::thread& other : others) other.join();
  if (first_exception) std::rethrow_exception(first_exception);
}

}  // namespace pds
