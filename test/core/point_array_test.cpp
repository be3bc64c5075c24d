// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <pcl_pds_recon/point_array.h>

#include <cstdint>
#include <numeric>
#include <thread>
#include <vector>

namespace
{

using Numbers = pds::PointArray<std::uint32_t>;

constexpr std::size_t large = std::size_t{5} << 20;  // numbers; ten huge pages

Numbers counted(std::size_t size, std::uint32_t first)
{
  Numbers numbers(size);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
}

/** \brief True if nothing else has written to the memory of these numbers. */
bool is_counted(const Numbers& numbers, std::uint32_t first)
{
  for (const std::uint32_t number : numbers)
    if (number != first++) return false;
  return true;
}

TEST(PageRecycling, GivesEachPageToOneArray)
{
  const pds::PageRecycling recycling;
  const Numbers kept = counted(large, 1);
  counted(large, 2);      // its pages are free at once,
  counted(large / 3, 3);  // and some of them serve smaller arrays,
  const Numbers small = counted(large / 2, 4);
  const Numbers larger = counted(2 * large, 5);  // or are the first ones of a larger one
  Numbers grown = counted(large, 6);
  grown.resize(3 * large, 7);
  EXPECT_TRUE(is_counted(kept, 1));
  EXPECT_TRUE(is_counted(small, 4));
  EXPECT_TRUE(is_counted(larger, 5));
  grown.resize(large);
  EXPECT_TRUE(is_counted(grown, 6));
}

TEST(PageRecycling, ServesRunsThatOverlap)
{
  const Numbers outside = counted(large, 1);
  const auto run = [](std::uint32_t first, bool& intact) {
    const pds::PageRecycling recycling;
    const Numbers kept = counted(large / 2, first);
    for (std::uint32_t round = 0; round < 20; ++round) intact = intact && is_counted(counted(large, round), round);
    intact = intact && is_counted(kept, first);
  };
  bool intact[] = {true, true, true};
  std::vector<std::thread> runs;
  for (std::uint32_t r = 0; r < 3; ++r) runs.emplace_back(run, r, std::ref(intact[r]));
  for (std::thread& thread : runs) thread.join();
  for (const bool all_right : intact) EXPECT_TRUE(all_right);
  EXPECT_TRUE(is_counted(outside, 1));
}

TEST(PageRecycling, TakesBackArraysThatOutliveIt)
{
  Numbers survivor;
  {
    const pds::PageRecycling recycling;
    counted(large, 1);
    survivor = counted(large, 2);
  }
  EXPECT_TRUE(is_counted(survivor, 2));
  survivor = counted(2 * large, 3);
  EXPECT_TRUE(is_counted(survivor, 3));
}

}  // namespace
