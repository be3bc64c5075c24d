// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/outliers.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "core_testing.h"

/** \brief Points that belong to no surface are left out, and only they. */
namespace pds_test
{
namespace
{

constexpr double interval = 0.0243;  // of 100,000 random points of the unit sphere: their 15 nearest are this far away

/** \brief The points, and so many scattered in the box [-2, 2]^3 behind them. */
Points with_scatter(Points points, std::size_t count)
{
  Random random(7);
  for (std::size_t i = 0; i < count; ++i) points.push_back(random.in_box(2));
  return points;
}

std::size_t count_outliers(const Points& points)
{
  const Stages stages(points);
  const std::vector<std::uint8_t> outlier = pds::find_outliers(stages.points, stages.graph, stages.parallel);
  return std::accumulate(outlier.begin(), outlier.end(), std::size_t{0});
}

/** \brief A sphere sampled ten times as densely above z = 0 as below. */
Points uneven_sphere(std::size_t count)
{
  Random random(3);
  Points points;
  for (const Eigen::Vector3d& p : sphere(count))
    if (p.z() > 0 || random.uniform() < 0.1) points.push_back(p);
  return points;
}

TEST(Outliers, AreNotOnAnySurface)
{
  EXPECT_EQ(count_outliers(sphere(small_cloud)), 0U);
  EXPECT_EQ(count_outliers(cube(small_cloud)), 0U);
  EXPECT_EQ(count_outliers(two_holed_plate(small_cloud)), 0U);
  EXPECT_EQ(count_outliers(saddle(small_cloud)), 0U);  // points of a rim reach farther than others
  EXPECT_EQ(count_outliers(uneven_sphere(small_cloud)), 0U);
}

TEST(Outliers, OfTwoPointsThereIsNone) { EXPECT_EQ(count_outliers({{0, 0, 0}, {1, 0, 0}}), 0U); }

TEST(Outliers, ThatAreFarFromTheSurfaceAreFoundAndOthersAreNot)
{
  const std::size_t scattered = large_cloud / 20;
  const Points points = with_scatter(sphere(large_cloud), scattered);
  const pds::Reconstruction mesh = reconstruct(points);
  expect_closed(mesh, points, 0);
  std::size_t lost = 0;
  std::size_t left = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool out = mesh.voronoi.label[i] == pds::no_label;
    if (i < large_cloud)
      lost += out ? 1 : 0;
    else if (std::abs(points[i].norm() - 1) > 2 * interval)
      left += out ? 0 : 1;
  }
  EXPECT_EQ(lost, 0U);
  EXPECT_LE(left, scattered / 100);
  EXPECT_GE(mesh.report.outliers, scattered * 9 / 10);
  EXPECT_EQ(std::count(mesh.voronoi.label.begin(), mesh.voronoi.label.end(), pds::no_label),
            static_cast<std::ptrdiff_t>(mesh.report.outliers));
}

/** Where they would be the first seeds. A crease stands off the planes of its neighbours as well, and stays. */
TEST(Outliers, ThatAreNearTheSurfaceAreFoundAndCreasesAreNot)
{
  const Points points = with_scatter(cube(large_cloud), large_cloud / 20);
  const double interval_of_cube = 2.0 / 3.0 * std::sqrt(15 * 24.0 / (pi * large_cloud));
  const pds::Reconstruction mesh = reconstruct(points);
  expect_closed(mesh, points, 0);
  std::size_t lost = 0;
  std::size_t near = 0;
  std::size_t left = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool out = mesh.voronoi.label[i] == pds::no_label;
    if (i < large_cloud) {
      lost += out ? 1 : 0;
      continue;
    }
    const double height = std::abs(points[i].cwiseAbs().maxCoeff() - 1) / interval_of_cube;
    if (points[i].cwiseAbs().minCoeff() > 0.9 || height < 0.5 || height > 2) continue;
    ++near;
    left += out ? 0 : 1;
  }
  EXPECT_LE(lost, large_cloud / 10000);
  EXPECT_GT(near, 50U);
  EXPECT_LE(left, near / 10);
}

TEST(Outliers, DoNotChangeTheRadius)
{
  const double alone = reconstruct(sphere(large_cloud)).report.radius;
  EXPECT_NEAR(reconstruct(with_scatter(sphere(large_cloud), large_cloud / 20)).report.radius, alone, 0.03 * alone);
}

TEST(Outliers, AreTheSameForAnyOrderAndNumberOfThreads)
{
  Points points = with_scatter(sphere(small_cloud), small_cloud / 20);
  pds::Options options;
  options.threads = 1;
  const pds::Reconstruction one = reconstruct(points, options);
  const Points of_one = vertex_positions(one, points);
  Random(5).shuffle(points);
  options.threads = 3;
  const pds::Reconstruction three = reconstruct(points, options);
  EXPECT_EQ(of_one, vertex_positions(three, points));
  EXPECT_EQ(one.triangles, three.triangles);
}

/** \brief A search that knows no neighbours of a point far off, as one within a radius. */
TEST(Outliers, MayHaveNoNeighborsInTheCallersSearch)
{
  const Points points = joined(with_scatter(sphere(5000), 50), {{50, 0, 0}});
  pds::PointCloudView cloud = view_of(points);
  cloud.neighbor_search = [&](std::uint32_t query, std::size_t count, std::vector<std::uint32_t>& found) {
    constexpr double reach = 0.5;
    std::vector<std::pair<double, std::uint32_t>> near;
    for (std::uint32_t i = 0; i < points.size(); ++i)
      if (const double distance = (points[i] - points[query]).norm(); distance < reach) near.emplace_back(distance, i);
    std::sort(near.begin(), near.end());
    if (near.size() > count) near.resize(count);
    for (const auto& [distance, i] : near) found.push_back(i);
    if (points[query].norm() > 40) found.clear();
  };
  const pds::Reconstruction mesh = pds::reconstruct(cloud, {});
  expect_sound_mesh(mesh, points);
  EXPECT_GT(mesh.report.outliers, 0U);
}

}  // namespace
}  // namespace pds_test
