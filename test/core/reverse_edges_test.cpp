// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <random>
#include <vector>

#include "reverse_edges.h"

namespace
{

/** \brief Some edges from each point, to points anywhere. */
std::vector<pds::ReverseEdge> random_edges(std::uint32_t point_count)
{
  std::mt19937 random(point_count);
  std::vector<pds::ReverseEdge> edges;
  for (std::uint32_t lister = 0; lister < point_count; ++lister)
    for (auto left = random() % 4; left > 0; --left)
      edges.push_back({static_cast<std::uint32_t>(random() % point_count), lister});
  return edges;
}

pds::NeighborGraph file(std::uint32_t point_count, const std::vector<pds::ReverseEdge>& edges, unsigned threads)
{
  pds::ReverseEdges reverse(point_count, 2);
  auto first = edges.begin();
  for (std::size_t tile = 0; tile < reverse.tile_count(); ++tile) {
    const auto last = std::partition_point(
        first, edges.end(), [&](const pds::ReverseEdge& e) { return e.lister < (tile + 1) * reverse.tile_size(); });
    if (first != last) reverse.add(tile % 2, tile, &*first, static_cast<std::size_t>(last - first));
    first = last;
  }
  pds::NeighborGraph graph;
  reverse.file(graph, pds::Parallel(threads));
  return graph;
}

}  // namespace

// Around the ends of tiles (2^12 points) and of the bases of the graph's rows (2^16).
class ReverseEdges : public testing::TestWithParam<std::uint32_t>
{
};

TEST_P(ReverseEdges, AreRowsOfTheListedPointsByAscendingLister)
{
  const std::uint32_t n = GetParam();
  const std::vector<pds::ReverseEdge> edges = random_edges(n);
  std::vector<std::vector<std::uint32_t>> expected(n);
  for (const pds::ReverseEdge& e : edges) expected[e.listed].push_back(e.lister);
  for (const unsigned threads : {1U, 3U}) {
    const pds::NeighborGraph graph = file(n, edges, threads);
    ASSERT_EQ(graph.size(), n);
    ASSERT_EQ(graph.reverse.size(), edges.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      const pds::NeighborSpan row = graph.listed_by(i);
      ASSERT_EQ(std::vector<std::uint32_t>(row.begin(), row.end()), expected[i]) << "point " << i << " of " << n;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Sizes,
                         ReverseEdges,
                         testing::Values(1U, 2U, 4095U, 4096U, 4097U, 65535U, 65536U, 65537U, 131072U, 200000U));

TEST(ReverseEdgesOfNothing, AreNoRows) { EXPECT_EQ(file(0, {}, 1).size(), 0U); }
