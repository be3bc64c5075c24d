// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/scan_noise.h>

#include "core_testing.h"

/** \brief Noise is told from shape, and seeds lie in its middle. */
namespace pds_test
{
namespace
{

/** \brief A unit sphere whose points are off it by normal deviates times sigma. */
Points noisy_sphere(std::size_t count, double sigma)
{
  Points points = sphere(count);
  Random random(2);
  for (Eigen::Vector3d& p : points) p *= 1 + sigma * random.normal();
  return points;
}

double mean_distance_from_sphere(const Points& points)
{
  double sum = 0;
  for (const Eigen::Vector3d& p : points) sum += std::abs(p.norm() - 1);
  return sum / static_cast<double>(points.size());
}

bool is_noisy(const Points& points)
{
  const Stages stages(points);
  return pds::is_noisy(stages.points, stages.graph, stages.parallel);
}

/** \brief Mean distance to the 15 nearest of so many random points of the unit sphere. */
double interval_of_sphere(std::size_t count) { return 2.0 / 3.0 * std::sqrt(15 * 4.0 / static_cast<double>(count)); }

TEST(ScanNoise, IsNeitherBendsNorCreasesNorAnUnevenDensity)
{
  EXPECT_FALSE(is_noisy(sphere(small_cloud)));
  EXPECT_FALSE(is_noisy(sphere(300)));  // coarse: the surface bends within every neighbourhood
  EXPECT_FALSE(is_noisy(cube(small_cloud)));
  EXPECT_FALSE(is_noisy(cube(2000)));
  EXPECT_FALSE(is_noisy(two_holed_plate(small_cloud)));
  EXPECT_FALSE(is_noisy(joined(sphere(small_cloud), plane(small_cloud / 10, 5))));
}

TEST(ScanNoise, IsSeenFromAQuarterToAWholeInterval)
{
  const double interval = interval_of_sphere(small_cloud);
  EXPECT_FALSE(is_noisy(noisy_sphere(small_cloud, 0.05 * interval)));
  for (const double intervals : {0.25, 0.5, 1.0})
    EXPECT_TRUE(is_noisy(noisy_sphere(small_cloud, intervals * interval)));
}

TEST(ScanNoise, IsSmoothedToAThird)
{
  const Points points = noisy_sphere(small_cloud, 0.5 * interval_of_sphere(small_cloud));
  const Stages stages(points);
  const pds::PointArray<Eigen::Vector3f> smooth = pds::smooth_positions(stages.points, stages.graph, stages.parallel);
  Points in_place;
  for (const Eigen::Vector3f& p : smooth)
    in_place.emplace_back(stages.points.origin + stages.points.unit * p.cast<double>());
  EXPECT_LT(mean_distance_from_sphere(in_place), mean_distance_from_sphere(points) / 3);
}

class NoisySphere : public testing::TestWithParam<double>
{
};

INSTANTIATE_TEST_SUITE_P(Intervals, NoisySphere, testing::Values(0.25, 0.5, 1.0));

/** Seeds are points of the cloud: drawn by lot they would have all of its noise. */
TEST_P(NoisySphere, IsClosedAndItsVerticesLieInTheMiddleOfTheNoise)
{
  const double interval = interval_of_sphere(large_cloud);
  const Points points = noisy_sphere(large_cloud, GetParam() * interval);
  const pds::Reconstruction mesh = reconstruct(points);
  expect_closed(mesh, points, 0);
  EXPECT_TRUE(mesh.report.smoothed);
  EXPECT_LT(mean_distance_from_sphere(vertex_positions(mesh, points)), 0.6 * mean_distance_from_sphere(points));
  EXPECT_NEAR(mesh.report.sampling_interval, interval, 0.1 * interval);  // the surface's, not that of the layers
}

/** \brief Points of one half of the sphere, or of a square with a hole cut in its middle, with noise of half an
 * interval. Both have rims that are no gaps. */
TEST(NoisyClouds, KeepTheRimsOfOpenSurfaces)
{
  const double interval = interval_of_sphere(2 * small_cloud);
  Points bowl = noisy_sphere(2 * small_cloud, 0.5 * interval);
  bowl.erase(std::remove_if(bowl.begin(), bowl.end(), [](const Eigen::Vector3d& p) { return p.z() < 0; }), bowl.end());
  EXPECT_EQ(expect_sound(reconstruct(bowl), bowl).boundary_loops, 1U);

  Points drilled;
  Random random(3);
  for (Eigen::Vector3d p : plane(2 * small_cloud)) {
    if (p.norm() < 0.25) continue;  // a perimeter of 36 radii
    p.z() += 0.5 * interval * random.normal();
    drilled.push_back(p);
  }
  EXPECT_EQ(expect_sound(reconstruct(drilled), drilled).boundary_loops, 2U);
}

TEST(NoisyClouds, GiveTheSameForAnyNumberOfThreads)
{
  const Points points = noisy_sphere(small_cloud, 0.5 * interval_of_sphere(small_cloud));
  pds::Options options;
  options.threads = 1;
  const pds::Reconstruction one = reconstruct(points, options);
  options.threads = 4;
  const pds::Reconstruction four = reconstruct(points, options);
  EXPECT_EQ(one.seeds, four.seeds);
  EXPECT_EQ(one.triangles, four.triangles);
  EXPECT_EQ(one.voronoi.label, four.voronoi.label);
}

TEST(NoisyClouds, AreSmoothedWhateverSearchTheCallerBrings)
{
  const Points points = noisy_sphere(2000, 0.5 * interval_of_sphere(2000));
  pds::PointCloudView cloud = view_of(points);
  cloud.neighbor_search = [&points](std::uint32_t query, std::size_t count, std::vector<std::uint32_t>& found) {
    std::vector<std::pair<double, std::uint32_t>> order;
    for (std::uint32_t i = 0; i < points.size(); ++i) order.emplace_back((points[i] - points[query]).squaredNorm(), i);
    std::partial_sort(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(count), order.end());
    for (std::size_t i = 0; i < count; ++i) found.push_back(order[i].second);
  };
  EXPECT_EQ(pds::reconstruct(cloud, {}).triangles, reconstruct(points).triangles);
}

/** \brief Seeds stay where they are, though distances are measured between points that were moved. */
TEST(NoisyClouds, HaveSeedsAtNoDistanceFromThemselvesIfTheyAreThinned)
{
  Random random(11);
  Points points = sphere(30000);
  for (Eigen::Vector3d& p : points) p *= 1 + 0.02 * random.normal();
  pds::Options options;
  options.radius_factor = 8;
  const pds::Reconstruction mesh = reconstruct(points, options);
  ASSERT_TRUE(mesh.report.smoothed);
  ASSERT_GT(mesh.report.thinned_points, 0U);
  for (const std::uint32_t seed : mesh.seeds) EXPECT_EQ(mesh.voronoi.distance[seed], 0.0F);
}

}  // namespace
}  // namespace pds_test
