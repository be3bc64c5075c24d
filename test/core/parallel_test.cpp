// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <pcl_pds_recon/parallel.h>

#include <atomic>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

namespace pds_test
{
namespace
{

using pds::Parallel;

TEST(Parallel, VisitsEveryIndexOnce)
{
  for (const unsigned threads : {1U, 2U, 7U}) {
    const Parallel parallel(threads);
    for (const std::size_t count : {0U, 1U, 99U, 100U, 101U, 5000U}) {
      std::vector<int> visits(count);
      parallel.blocks(count, 100, [&](std::size_t begin, std::size_t end, unsigned worker) {
        EXPECT_LT(worker, parallel.threads());
        EXPECT_LE(end - begin, 100U);
        for (std::size_t i = begin; i < end; ++i) ++visits[i];
      });
      EXPECT_EQ(visits, std::vector<int>(count, 1));
    }
  }
}

TEST(Parallel, GivesWorkersDifferentNumbers)
{
  const Parallel parallel(4);
  for (int loop = 0; loop < 200; ++loop) {
    std::vector<std::atomic<int>> inside(parallel.threads());
    parallel.blocks(64, 1, [&](std::size_t, std::size_t, unsigned worker) {
      EXPECT_EQ(inside[worker]++, 0);
      std::this_thread::yield();
      --inside[worker];
    });
  }
}

TEST(Parallel, AddsUpInTheOrderOfTheBlocks)
{
  const auto sum = [](unsigned threads) {
    return Parallel(threads).sum(10000, 7, [](std::size_t begin, std::size_t end) {
      double part = 0;
      for (std::size_t i = begin; i < end; ++i) part += std::sin(static_cast<double>(i));
      return part;
    });
  };
  for (const unsigned threads : {2U, 3U, 8U}) EXPECT_EQ(sum(threads), sum(1));
}

TEST(Parallel, RethrowsAnExceptionAndGoesOn)
{
  const Parallel parallel(3);
  for (int loop = 0; loop < 20; ++loop) {
    EXPECT_THROW(parallel.each(1000, 1,
                               [](std::size_t i) {
                                 if (i == 500) throw std::runtime_error("500");
                               }),
                 std::runtime_error);
    std::atomic<int> visits{0};
    parallel.each(1000, 10, [&](std::size_t) { ++visits; });
    EXPECT_EQ(visits, 1000);
  }
}

TEST(Parallel, RunsLoopsWithinLoopsAndFromOtherThreads)
{
  const Parallel parallel(3);
  const Parallel copy = parallel;
  std::atomic<int> visits{0};
  const auto nested = [&](const Parallel& outer) {
    outer.each(20, 1, [&](std::size_t) { parallel.each(50, 1, [&](std::size_t) { ++visits; }); });
  };
  std::thread other([&] { nested(copy); });
  nested(parallel);
  other.join();
  EXPECT_EQ(visits, 2 * 20 * 50);
}

}  // namespace
}  // namespace pds_test
