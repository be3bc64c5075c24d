// SPDX-License-Identifier: BSD-3-Clause
// Memory of large arrays: what was freed is used again, and nothing else changes.
#include "page_pool.h"

#include <gtest/gtest.h>
#include <pcl_pds_recon/point_array.h>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <random>
#include <thread>
#include <vector>

#if defined(__linux__)
namespace
{

constexpr std::size_t pages = 4;  // enough for an array to count as large

/** \brief True if the memory holds nothing but this byte. */
bool holds(const void* memory, std::size_t bytes, unsigned char value)
{
  const auto* const first = static_cast<const unsigned char*>(memory);
  return std::all_of(first, first + bytes, [value](unsigned char byte) { return byte == value; });
}

void write_and_free(std::size_t bytes, unsigned char value)
{
  void* const memory = pds::allocate_large(bytes);
  std::memset(memory, value, bytes);
  pds::free_large(memory, bytes);
}

TEST(PagePool, PagesThatWereFreedComeFirst)
{
  const pds::PageReuse reuse;
  write_and_free(pages * pds::huge_page, 0xab);
  char* const larger = static_cast<char*>(pds::allocate_large(2 * pages * pds::huge_page));
  EXPECT_TRUE(holds(larger, pages * pds::huge_page, 0xab));
  EXPECT_TRUE(holds(larger + pages * pds::huge_page, pages * pds::huge_page, 0)) << "the system's";
  pds::free_large(larger, 2 * pages * pds::huge_page);
}

TEST(PagePool, PagesOfSeveralArraysMakeOne)
{
  const pds::PageReuse reuse;
  std::vector<void*> parts;
  for (int part = 0; part < 3; ++part) parts.push_back(pds::allocate_large(2 * pds::huge_page));
  for (void* part : parts) std::memset(part, 0x17, 2 * pds::huge_page);
  for (void* part : parts) pds::free_large(part, 2 * pds::huge_page);
  void* const whole = pds::allocate_large(6 * pds::huge_page);
  EXPECT_TRUE(holds(whole, 6 * pds::huge_page, 0x17));
  pds::free_large(whole, 6 * pds::huge_page);
}

TEST(PagePool, PagesGoBackToTheSystemWithTheLastUser)
{
  {
    const pds::PageReuse outer;
    {
      const pds::PageReuse inner;
    }
    write_and_free(pages * pds::huge_page, 0xab);
    void* const again = pds::allocate_large(pages * pds::huge_page);
    EXPECT_TRUE(holds(again, pages * pds::huge_page, 0xab));
    pds::free_large(again, pages * pds::huge_page);
  }
  void* const fresh = pds::allocate_large(pages * pds::huge_page);
  EXPECT_TRUE(holds(fresh, pages * pds::huge_page, 0));
  pds::free_large(fresh, pages * pds::huge_page);
}

TEST(PagePool, ArraysOutlastTheirUse)
{
  std::vector<int> expected(pages * pds::huge_page / sizeof(int), 5);
  pds::PointArray<int> kept;
  {
    const pds::PageReuse reuse;
    write_and_free(pages * pds::huge_page, 0xab);
    kept.assign(expected.begin(), expected.end());
  }
  EXPECT_TRUE(std::equal(kept.begin(), kept.end(), expected.begin(), expected.end()));
}

TEST(PagePool, ArraysOfSeveralThreadsStayApart)
{
  const auto work = [](std::uint32_t own) {
    std::mt19937 random(own);
    const pds::PageReuse reuse;
    std::vector<pds::PointArray<std::uint32_t>> arrays(4);
    for (int round = 0; round < 50; ++round) {
      pds::PointArray<std::uint32_t>& array = arrays[random() % arrays.size()];
      EXPECT_EQ(std::count(array.begin(), array.end(), own), static_cast<std::ptrdiff_t>(array.size()));
      pds::PointArray<std::uint32_t>().swap(array);
      array.resize(random() % (4 * pds::huge_page / sizeof(own)));
      std::fill(array.begin(), array.end(), own);
    }
    for (const auto& array : arrays)
      EXPECT_EQ(std::count(array.begin(), array.end(), own), static_cast<std::ptrdiff_t>(array.size()));
  };
  std::vector<std::thread> threads;
  for (std::uint32_t own = 1; own <= 4; ++own) threads.emplace_back(work, own);
  for (std::thread& thread : threads) thread.join();
}

}  // namespace
#endif
