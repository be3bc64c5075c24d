// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <set>

#include "core_testing.h"

/** \brief The seed graph that a reconstruction hands out. */
namespace pds_test
{
namespace
{

using Edge = std::array<std::uint32_t, 2>;

TEST(SeedEdges, AscendAndNameSeedsOnce)
{
  const pds::Reconstruction result = reconstruct(saddle(6000), pds::Options());
  ASSERT_GT(result.seed_edges.size(), 100U);
  EXPECT_TRUE(std::is_sorted(result.seed_edges.begin(), result.seed_edges.end()));
  EXPECT_EQ(std::adjacent_find(result.seed_edges.begin(), result.seed_edges.end()), result.seed_edges.end());
  for (const auto& [a, b] : result.seed_edges) {
    EXPECT_LT(a, b);
    EXPECT_LT(b, result.seeds.size());
  }
}

TEST(SeedEdges, AreNearlyTheEdgesOfAClosedMesh)
{
  // Of flat sides: where the surface bends, edges are flipped.
  const pds::Reconstruction result = reconstruct(cube(20000), pds::Options());
  std::set<Edge> of_mesh;
  for (const auto& triangle : result.triangles)
    for (std::size_t i = 0; i < 3; ++i)
      of_mesh.insert(Edge{std::min(triangle[i], triangle[(i + 1) % 3]), std::max(triangle[i], triangle[(i + 1) % 3])});
  ASSERT_EQ(of_mesh.size(), result.report.edges);
  const auto shared = std::count_if(result.seed_edges.begin(), result.seed_edges.end(),
                                    [&of_mesh](const Edge& edge) { return of_mesh.count(edge) != 0; });
  // Faces of more than three sides get chords that are not in the graph.
  EXPECT_GT(shared, 0.95 * static_cast<double>(result.report.edges));
  EXPECT_GT(shared, 0.95 * static_cast<double>(result.seed_edges.size()));
}

TEST(SeedEdges, AreNoneOfACloudWithoutSurface)
{
  EXPECT_TRUE(reconstruct(Points{}, pds::Options()).seed_edges.empty());
  EXPECT_TRUE(reconstruct(Points{{0, 0, 0}}, pds::Options()).seed_edges.empty());
}

}  // namespace
}  // namespace pds_test
