// SPDX-License-Identifier: BSD-3-Clause
#include "core_testing.h"

/** \brief What lies far away must not harm what is here. */
namespace pds_test
{
namespace
{

Points moved(Points points, const Eigen::Vector3d& by)
{
  for (Eigen::Vector3d& p : points) p += by;
  return points;
}

class StrayPoint : public testing::TestWithParam<double>
{
};

INSTANTIATE_TEST_SUITE_P(Distances, StrayPoint, testing::Values(1e2, 1e4, 1e6, 1e8));

TEST_P(StrayPoint, CostsTheOthersNoPrecision)
{
  const Points input = sphere(large_cloud);
  const pds::Reconstruction alone = reconstruct(input);
  const Points with_stray = joined(input, {Eigen::Vector3d(GetParam(), 0, 0)});
  const pds::Reconstruction mesh = reconstruct(with_stray);
  expect_closed(mesh, with_stray, 0);
  EXPECT_NEAR(mesh.report.radius, alone.report.radius, 0.01 * alone.report.radius);
  const auto expected = static_cast<double>(alone.report.vertices);
  EXPECT_NEAR(static_cast<double>(mesh.report.vertices), expected, 0.03 * expected);
}

/** \brief One in a hundred points is flung about: among each other they look like a very coarse cloud. */
TEST(StrayPoints, AHundredthOfThePointsHidesNoSurface)
{
  const Points input = sphere(large_cloud);
  Points flung;
  Random random(8);
  while (flung.size() < input.size() / 100) flung.push_back(random.in_box(1e4));
  const Points cloud = joined(input, flung);
  const pds::Reconstruction alone = reconstruct(input);
  const pds::Reconstruction mesh = reconstruct(cloud);
  expect_closed(mesh, cloud, 0);
  EXPECT_NEAR(mesh.report.radius, alone.report.radius, 0.01 * alone.report.radius);
}

TEST(StrayPoints, ARowOfZerosAmongUtmCoordinatesIsHarmless)
{
  Points input = moved(sphere(small_cloud), {500000, 5300000, 100});
  input.emplace_back(0, 0, 0);
  expect_closed(reconstruct(input), input, 0);
}

TEST(StrayPoints, AFarClusterBeyondSinglePrecisionIsMergedNotFolded)
{
  const Points far = joined(sphere(small_cloud), moved(sphere(small_cloud), {1e9, 0, 0}));
  expect_sound(reconstruct(far), far);
}

}  // namespace
}  // namespace pds_test
