// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/nearest_neighbors.h>

#include <algorithm>

#include "core_testing.h"
#include "neighbor_kernel.h"

namespace pds_test
{
namespace
{

using Positions = pds::PointArray<Eigen::Vector3f>;

float squared_distance(const Eigen::Vector3f& a, const Eigen::Vector3f& b)
{
  const Eigen::Vector3f d = a - b;
  return d.x() * d.x() + d.y() * d.y() + d.z() * d.z();
}

std::vector<std::uint32_t> brute_force_row(const Positions& position, std::size_t i, std::size_t k)
{
  std::vector<std::pair<float, std::uint32_t>> all;
  for (std::uint32_t j = 0; j < position.size(); ++j)
    if (j != i) all.emplace_back(squared_distance(position[i], position[j]), j);
  std::sort(all.begin(), all.end());
  std::vector<std::uint32_t> row;
  for (std::size_t j = 0; j < k; ++j) row.push_back(all[j].second);
  return row;
}

/** \brief With every instruction set that this machine has. */
void expect_equal_to_brute_force(const Positions& position, std::size_t k)
{
  std::vector<std::uint32_t> expected;
  for (std::size_t i = 0; i < position.size(); ++i) {
    const std::vector<std::uint32_t> row = brute_force_row(position, i, k);
    expected.insert(expected.end(), row.begin(), row.end());
  }
  for (const pds::NeighborKernel* kernel : pds::neighbor_kernels()) {
    const pds::PointArray<std::uint32_t> found = pds::nearest_neighbors(position, k, *kernel, pds::Parallel(2));
    ASSERT_EQ(found.size(), expected.size());
    const auto [wrong, right] = std::mismatch(found.begin(), found.end(), expected.begin());
    ASSERT_EQ(wrong, found.end()) << kernel->name << ", k " << k << ", point " << (wrong - found.begin()) / k
                                  << ": found " << *wrong << " instead of " << *right;
  }
}

Positions random_positions(std::size_t count)
{
  Random random(11);
  Positions position;
  while (position.size() < count) position.push_back(random.in_box(0.5).cast<float>());
  return position;
}

/** \brief In Morton order, as the library calls it. */
Positions in_order(const Points& points) { return pds::order_points(view_of(points), pds::Parallel(1)).position; }

TEST(NearestNeighbors, EqualBruteForceForEveryK)
{
  const Positions position = in_order(torus(400));
  for (std::size_t k = 4; k <= 30; ++k) expect_equal_to_brute_force(position, k);
}

TEST(NearestNeighbors, AreRightInAnyOrder) { expect_equal_to_brute_force(random_positions(1500), 15); }

TEST(NearestNeighbors, BreakTiesOfAGridByIndex)
{
  Points grid;
  for (int x = 0; x < 12; ++x)
    for (int y = 0; y < 12; ++y)
      for (int z = 0; z < 3; ++z) grid.emplace_back(x, y, z);
  for (const std::size_t k : {4U, 6U, 15U, 30U}) expect_equal_to_brute_force(in_order(grid), k);
}

TEST(NearestNeighbors, AreRightOnALine)
{
  Points line;
  for (int i = 0; i < 300; ++i) line.emplace_back(i * 0.25, i * 0.5, 0);
  expect_equal_to_brute_force(in_order(line), 15);
}

TEST(NearestNeighbors, AreRightWhereFloatsCoincide)
{
  Positions position;
  for (int i = 0; i < 40; ++i)
    for (int copy = 0; copy < 10; ++copy) position.emplace_back(0.01F * static_cast<float>(i), 0.1F, 0.2F);
  for (const std::size_t k : {5U, 9U, 15U}) expect_equal_to_brute_force(position, k);
}

/** \brief Neighbours thousands of times closer here than there, strays in between: no guess from before holds. */
TEST(NearestNeighbors, AreRightWhereDensityJumps)
{
  Random random(5);
  Points points = sphere(500);
  for (int i = 0; i < 1500; ++i) points.push_back(Eigen::Vector3d(1, 0, 0) + 1e-4 * random.in_box(1));
  for (int i = 0; i < 40; ++i) points.push_back(50 * random.in_box(1));
  for (const std::size_t k : {4U, 15U, 64U, 200U}) expect_equal_to_brute_force(in_order(points), k);
}

/** \brief One point amid a sphere of equally distant ones: too many candidates, and no reach that keeps only a few. */
TEST(NearestNeighbors, AreRightInTheMiddleOfASphere)
{
  Points points = sphere(3000);
  points.emplace_back(0, 0, 0);
  expect_equal_to_brute_force(in_order(points), 15);
}

TEST(NearestNeighbors, DoNotDependOnInstructionSetOrThreads)
{
  const Positions position = in_order(torus(large_cloud));
  const pds::PointArray<std::uint32_t> expected =
      pds::nearest_neighbors(position, 15, pds::baseline_kernel, pds::Parallel(1));
  for (const pds::NeighborKernel* kernel : pds::neighbor_kernels())
    for (const unsigned threads : {1U, 2U, 3U})
      EXPECT_TRUE(pds::nearest_neighbors(position, 15, *kernel, pds::Parallel(threads)) == expected)
          << kernel->name << ", " << threads << " threads";
}

TEST(NearestNeighbors, TakeAllOthersOfTheSmallestCloud)
{
  for (const std::size_t k : {4U, 8U, 15U}) expect_equal_to_brute_force(random_positions(k + 1), k);
}

TEST(NeighborGraph, IsSymmetricAndItsRowsAreOrdered)
{
  const Stages stages(joined(swiss_roll(3000), sphere(200)));
  const pds::NeighborGraph& graph = stages.graph;
  const auto distance = [&](std::size_t i, std::size_t j) {
    return squared_distance(stages.points.position[i], stages.points.position[j]);
  };
  for (std::uint32_t i = 0; i < graph.size(); ++i) {
    const pds::NeighborSpan own = graph.nearest(i);
    const pds::NeighborRange all = graph.neighbors(i);
    EXPECT_EQ(own.size(), 15U);
    EXPECT_TRUE(std::is_sorted(own.begin(), own.end(),
                               [&](std::uint32_t a, std::uint32_t b) { return distance(i, a) < distance(i, b); }));
    EXPECT_TRUE(std::equal(own.begin(), own.end(), all.begin())) << "its own neighbours come first";
    EXPECT_TRUE(std::is_sorted(std::next(all.begin(), 15), all.end()));
    EXPECT_EQ(std::set<std::uint32_t>(all.begin(), all.end()).size(), all.size()) << "no neighbour twice";
    for (const std::uint32_t j : all) {
      const pds::NeighborRange back = graph.neighbors(j);
      ASSERT_EQ(std::count(back.begin(), back.end(), i), 1) << i << " is a neighbour of " << j << " too";
    }
  }
}

TEST(NeighborGraph, FilesReverseEdgesOfLargeClouds)
{
  const Stages stages(torus(150000));  // more than two of the blocks in which rows are filed
  const pds::NeighborGraph& graph = stages.graph;
  ASSERT_GT(graph.size() >> pds::NeighborGraph::base_bits, 1U);
  const auto lists = [&](std::size_t i, std::uint32_t j) {
    const pds::NeighborSpan own = graph.nearest(i);
    return std::find(own.begin(), own.end(), j) != own.end();
  };
  std::size_t one_sided = 0;
  for (std::uint32_t i = 0; i < graph.size(); ++i) {
    for (const std::uint32_t j : graph.nearest(i)) one_sided += lists(j, i) ? 0 : 1;
    for (const std::uint32_t j : graph.listed_by(i)) {
      ASSERT_TRUE(lists(j, i) && !lists(i, j)) << i << " " << j;
      one_sided -= 1;
    }
  }
  EXPECT_EQ(one_sided, 0U) << "every edge that one end lists is filed with the other";
}

TEST(NeighborGraph, HasEveryOtherPointAsNeighbourInASmallCloud)
{
  for (std::size_t count = 0; count <= 16; ++count) {
    const Stages stages(sphere(count));
    EXPECT_EQ(stages.graph.size(), count);
    for (std::size_t i = 0; i < count; ++i) EXPECT_EQ(stages.graph.nearest(i).size(), count - 1);
  }
}

TEST(NeighborGraph, MeasuresTheSamplingInterval)
{
  const Stages stages(torus(800));
  double sum = 0;
  for (std::size_t i = 0; i < 800; ++i)
    for (const std::uint32_t j : brute_force_row(stages.points.position, i, 15))
      sum += std::sqrt(static_cast<double>(squared_distance(stages.points.position[i], stages.points.position[j])));
  EXPECT_NEAR(stages.graph.sampling_interval, sum / (800 * 15), 1e-6 * stages.graph.sampling_interval);
}

/** \brief The caller's search in these tests: brute force over a cloud, itself included, farthest first. */
std::vector<std::uint32_t> search(const Points& input, std::uint32_t query, std::size_t count)
{
  std::vector<std::pair<double, std::uint32_t>> all;
  for (std::uint32_t j = 0; j < input.size(); ++j)
    if (input[j].allFinite()) all.emplace_back((input[j] - input[query]).squaredNorm(), j);
  std::sort(all.begin(), all.end());
  all.resize(std::min(count, all.size()));
  std::vector<std::uint32_t> found;
  for (auto entry = all.rbegin(); entry != all.rend(); ++entry) found.push_back(entry->second);
  return found;
}

TEST(NeighborGraph, UsesTheCallersSearch)
{
  Points input = joined(saddle(400), saddle(100));  // 100 points twice: the search must be asked for more
  input.emplace_back(std::nan(""), 0, 0);
  pds::PointCloudView cloud = view_of(input);
  std::size_t calls = 0;
  cloud.neighbor_search = [&](std::uint32_t query, std::size_t count, std::vector<std::uint32_t>& neighbors) {
    ++calls;
    neighbors = search(input, query, count);
  };
  const Stages own(input);
  const pds::NeighborGraph graph = pds::build_neighbor_graph(own.points, cloud, 15, pds::Parallel(2));
  EXPECT_GE(calls, 400U);
  EXPECT_EQ(graph.own, own.graph.own);
  EXPECT_EQ(graph.reverse, own.graph.reverse);
  EXPECT_EQ(graph.sampling_interval, own.graph.sampling_interval);
}

TEST(NeighborGraph, KeepsToWhatTheCallersSearchFinds)
{
  const Points input = sphere(60);
  pds::PointCloudView cloud = view_of(input);
  cloud.neighbor_search = [](std::uint32_t, std::size_t, std::vector<std::uint32_t>& neighbors) {
    neighbors = {7, 7, 9, 1000};  // twice the same, and one that there is not
  };
  const Stages own(input);
  const pds::NeighborGraph graph = pds::build_neighbor_graph(own.points, cloud, 15, pds::Parallel(1));
  const std::set<std::uint32_t> allowed{own.points.rank_of_input[7], own.points.rank_of_input[9]};
  for (std::uint32_t i = 0; i < graph.size(); ++i) {
    const pds::NeighborSpan row = graph.nearest(i);
    EXPECT_EQ(row.size(), allowed.count(i) != 0 ? 1U : 2U);
    for (const std::uint32_t j : row) EXPECT_EQ(allowed.count(j), 1U);
  }
}

}  // namespace
}  // namespace pds_test
