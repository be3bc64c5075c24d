// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "core_testing.h"

/** \brief Where points are too far apart for the radius, all of them become vertices, and the mesh is whole. */
namespace pds_test
{
namespace
{

/** \brief Leaves one in so many of the points with x > 0. */
Points thinned_beyond(const Points& points, std::uint64_t ratio)
{
  Random random(ratio);
  Points rest;
  std::copy_if(points.begin(), points.end(), std::back_inserter(rest),
               [&](const Eigen::Vector3d& p) { return p.x() < 0 || random.below(ratio) == 0; });
  return rest;
}

class UnevenDensity : public testing::TestWithParam<std::uint64_t>
{
};

INSTANTIATE_TEST_SUITE_P(Ratios, UnevenDensity, testing::Values(3, 10, 30));

TEST_P(UnevenDensity, LeavesASphereClosed)
{
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    const Points points = thinned_beyond(sphere(4 * large_cloud, seed), GetParam());
    expect_closed(reconstruct(points), points, 0);
  }
}

TEST_P(UnevenDensity, LeavesATorusClosed)
{
  const Points points = thinned_beyond(torus(4 * large_cloud), GetParam());
  expect_closed(reconstruct(points), points, 1);
}

TEST_P(UnevenDensity, LeavesTheRimOfAPlane)
{
  const Points points = thinned_beyond(plane(4 * large_cloud), GetParam());
  const pds::Reconstruction mesh = reconstruct(points);
  const MeshFacts facts = expect_sound(mesh, points);
  EXPECT_EQ(facts.components, 1U);
  EXPECT_EQ(facts.boundary_loops, 1U);
}

/** \brief Of two openings as wide, the one in the dense part stays open and the one between few points is filled, as
 * each is by the distances of the points around it; a wide one stays open in both. */
TEST(SparseParts, HaveHoleLimitsOfTheirOwn)
{
  // Of a tenth of the points on a square of 2 x 2.
  const double sparse_interval = 1.46 * 2 / std::sqrt(4.0 * large_cloud / 10);
  const auto loops = [](double width) {
    Points points = thinned_beyond(plane(4 * large_cloud), 10);
    points.erase(
        std::remove_if(points.begin(), points.end(),
                       [&](const Eigen::Vector3d& p) { return std::hypot(std::abs(p.x()) - 0.5, p.y()) < width / 2; }),
        points.end());
    const pds::Reconstruction mesh = reconstruct(points);
    return expect_sound(mesh, points).boundary_loops;
  };
  EXPECT_EQ(loops(5 * sparse_interval), 2U);
  EXPECT_EQ(loops(16 * sparse_interval), 3U);
}

/** \brief A point alone off a surface has far neighbours; but these have near ones. */
TEST(SparseParts, AreNotWhereAPointStandsAlone)
{
  const Points surface = plane(large_cloud);
  const double interval = reconstruct(surface).report.sampling_interval;
  const Points with_stray = joined(surface, {Eigen::Vector3d(0, 0, 4.5 * interval)});
  const pds::Reconstruction mesh = reconstruct(with_stray);
  const MeshFacts facts = expect_sound(mesh, with_stray);
  EXPECT_EQ(facts.boundary_loops, 1U);
  for (const Eigen::Vector3d& p : vertex_positions(mesh, with_stray)) EXPECT_EQ(p.z(), 0);
}

/** \brief As mixed pixels make them, between a silhouette and what is behind it. */
TEST(SparseParts, AreNoCurtains)
{
  const Points surface = plane(large_cloud);
  Points curtain;
  Random random(2);
  while (curtain.size() < large_cloud / 1000) curtain.emplace_back(2 * random.uniform() - 1, 1, 6 * random.uniform());
  const Points points = joined(surface, curtain);
  const pds::Reconstruction mesh = reconstruct(points);
  expect_sound(mesh, points);
  for (const Eigen::Vector3d& p : vertex_positions(mesh, points)) EXPECT_LT(p.z(), 1);
}

}  // namespace
}  // namespace pds_test
