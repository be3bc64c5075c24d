// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/parallel.h>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <mutex>
#include <thread>

namespace pds
{
namespace
{

/** \brief Leaves the core's units to another thread for an instant. */
void relax_core()
{
#if defined(__x86_64__) || defined(__i386__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  __asm__ __volatile__("yield");
#endif
}

/** \brief One loop: hands out its blocks and keeps the first exception. */
class Loop
{
 public:
  using Body = std::function<void(std::size_t, std::size_t, unsigned)>;

  Loop(std::size_t count, std::size_t block, const Body& body) : count_(count), block_(block), body_(body) {}

  [[nodiscard]] std::size_t block_count() const { return (count_ + block_ - 1) / block_; }

  /** \brief Runs blocks until none is left. */
  void work(unsigned worker)
  {
    try {
      for (std::size_t b = next_block_++; b < block_count(); b = next_block_++)
        body_(b * block_, std::min(count_, (b + 1) * block_), worker);
    } catch (...) {
      const std::lock_guard<std::mutex> lock(exception_mutex_);
      if (!first_exception_) first_exception_ = std::current_exception();
      next_block_ = block_count();
    }
  }

  /** \brief To be called when all workers are done. */
  void rethrow() const
  {
    if (first_exception_) std::rethrow_exception(first_exception_);
  }

 private:
  std::size_t count_;
  std::size_t block_;
  const Body& body_;
  std::atomic<std::size_t> next_block_{0};
  std::mutex exception_mutex_;
  std::exception_ptr first_exception_;
};

/** \brief True if it happens before long. A thread that sleeps takes longer to wake up than many loops take to run, and
 * the next one mostly comes at once. */
template <typename Event>
bool happens_soon(const Event& event)
{
  constexpr std::chrono::microseconds patience(50);  // about as long as it takes to fall asleep and wake up
  constexpr int looks = 64;                          // between two at the clock
  const auto end = std::chrono::steady_clock::now() + patience;
  do {
    for (int look = 0; look < looks; ++look) {
      if (event()) return true;
      relax_core();
    }
  } while (std::chrono::steady_clock::now() < end);
  return false;
}

}  // namespace

/** \brief Threads that sleep until there is a loop to help with, if it does not come soon. */
class Parallel::Team
{
 public:
  /** \param spin true if there is a core for each thread */
  explicit Team(bool spin) : spin_(spin) {}
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;
  ~Team()
  {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      dismissed_ = true;
    }
    loop_posted_.notify_all();
    for (std::thread& thread : threads_) thread.join();
  }

  /** \brief Runs \a loop with up to \a helpers threads beside this one; false if the team has another to run. */
  bool run(Loop& loop, unsigned helpers)
  {
    if (in_use_.exchange(true, std::memory_order_acquire)) return false;
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      loop_ = &loop;
      wanted_ = helpers;
      joined_ = 0;
      ++posted_;
    }
    enlist(helpers);
    for (unsigned helper = 0; helper < helpers; ++helper) loop_posted_.notify_one();
    loop.work(0);
    std::unique_lock<std::mutex> lock(mutex_);
    loop_ = nullptr;  // who has not come by now finds nothing left to do
    if (working_ > 0 && spin_) {
      lock.unlock();
      happens_soon([this] { return working_ == 0; });
      lock.lock();
    }
    helpers_left_.wait(lock, [this] { return working_ == 0; });
    in_use_.store(false, std::memory_order_release);
    return true;
  }

 private:
  void enlist(unsigned helpers)
  {
    try {
      while (threads_.size() < helpers) threads_.emplace_back([this] { help(); });
    } catch (...) {
      // No more threads, or no memory for them: those there are do all the work.
    }
  }

  void help()
  {
    std::unique_lock<std::mutex> lock(mutex_);
    for (;;) {
      loop_posted_.wait(lock, [this] { return dismissed_ || (loop_ != nullptr && joined_ < wanted_); });
      if (dismissed_) return;
      Loop& loop = *loop_;
      const unsigned worker = ++joined_;
      ++working_;
      lock.unlock();
      loop.work(worker);
      lock.lock();
      if (--working_ == 0) helpers_left_.notify_one();
      if (!spin_) continue;
      const std::uint64_t posted = posted_;
      lock.unlock();
      happens_soon([&] { return posted_ != posted; });
      lock.lock();
    }
  }

  const bool spin_;
  std::atomic<bool> in_use_{false};  ///< a loop runs
  std::vector<std::thread> threads_;
  // Written under the mutex, looked at without it by who waits for a change.
  std::atomic<std::uint64_t> posted_{0};  ///< loops so far
  std::atomic<unsigned> working_{0};      ///< helpers at work

  std::mutex mutex_;  ///< guards what follows
  std::condition_variable loop_posted_;
  std::condition_variable helpers_left_;
  Loop* loop_ = nullptr;
  unsigned wanted_ = 0;
  unsigned joined_ = 0;
  bool dismissed_ = false;
};

Parallel::Parallel(unsigned threads)
    : threads_(threads != 0 ? threads : std::max(1U, std::thread::hardware_concurrency()))
{
  if (threads_ > 1) team_ = std::make_shared<Team>(threads_ <= std::thread::hardware_concurrency());
}

void Parallel::blocks(std::size_t count,
                      std::size_t block,
                      const std::function<void(std::size_t, std::size_t, unsigned)>& body) const
{
  Loop loop(count, block, body);
  const auto workers = static_cast<unsigned>(std::min<std::size_t>(threads_, loop.block_count()));
  if (workers <= 1 || !team_->run(loop, workers - 1)) loop.work(0);
  loop.rethrow();
}

}  // namespace pds
