// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/nearest_neighbors.h>
#include <pcl_pds_recon/thinning.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>
#include <vector>

#include "core_testing.h"

/** \brief Only the midst of plane parts is thinned; rims, bends, thin parts and noise keep all of their points. */
namespace pds_test
{
namespace
{

constexpr std::size_t count = 60000;

/** \brief Mean distance to the 15 nearest of \a count random points on so large a surface. */
double interval_of(double area) { return 2.0 / 3.0 * std::sqrt(15 * area / (pi * count)); }

/** \brief Random points of the square [-1, 1]^2, moved by \a shape. */
Points square(const std::function<Eigen::Vector3d(double x, double y)>& shape, std::size_t size = count)
{
  Random random(3);
  Points points;
  while (points.size() < size) {
    const double x = random.uniform(-1, 1);
    points.push_back(shape(x, random.uniform(-1, 1)));
  }
  return points;
}

Points flat_square()
{
  // Aslant, for the sake of generality: planes along the axes are special to a grid.
  const Eigen::Quaterniond aslant(0.8, 0.3, -0.4, 0.33);
  const Eigen::Matrix3d turn = aslant.normalized().toRotationMatrix();
  return square([&](double x, double y) { return (turn * Eigen::Vector3d(x, y, 0)).eval(); });
}

pds::OrderedPoints thin(const Points& input, double radius, double thickest, unsigned threads = 2)
{
  const pds::Parallel parallel(threads);
  pds::OrderedPoints points = pds::order_points(view_of(input), parallel);
  const double unit = points.unit;
  return pds::thin_plane_parts(std::move(points), radius / unit, thickest / unit, parallel);
}

/** \brief As the reconstruction does by default, for a surface of that area. */
pds::OrderedPoints thin_for_area(const Points& input, double area)
{
  const double interval = interval_of(area);
  return thin(input, 3 * interval, 0.1 * interval);
}

bool represents_itself(const pds::OrderedPoints& points, std::size_t i)
{
  return points.input_index[points.rank_of_input[i]] == i;
}

TEST(PlaneThinning, LeavesOutNearlyHalfOfTheMidst)
{
  const Points input = flat_square();
  const pds::OrderedPoints points = thin_for_area(input, 4);
  EXPECT_GT(points.size(), count * 45 / 100);
  EXPECT_LT(points.size(), count * 65 / 100);
  EXPECT_EQ(points.size() + points.thinned_points, count);
}

TEST(PlaneThinning, RepresentsPointsByNearOnesOfTheInput)
{
  const Points input = flat_square();
  const pds::OrderedPoints points = thin_for_area(input, 4);
  const double radius = 3 * interval_of(4);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t rank = points.rank_of_input[i];
    ASSERT_LT(rank, points.size());
    EXPECT_LE((input[i] - input[points.input_index[rank]]).norm(),
              1.001 * std::sqrt(2.0) / pds::squares_per_radius_of_plane * radius);
  }
  for (std::uint32_t rank = 0; rank < points.size(); ++rank) {
    const Eigen::Vector3d local = (input[points.input_index[rank]] - points.origin) / points.unit;
    EXPECT_EQ(points.position[rank], local.cast<float>().eval());
  }
}

/** \brief At corners, a slanting cube may hold so little of the rim that the one beside it does not see it. */
TEST(PlaneThinning, KeepsNearlyAllPointsNearARim)
{
  const double radius = 3 * interval_of(4);
  const Points input = square([](double x, double y) { return Eigen::Vector3d(x, y, 0.3 * x + 0.1 * y); });
  const pds::OrderedPoints points = thin_for_area(input, 4);
  ASSERT_GT(points.thinned_points, 0U);
  std::size_t near = 0, left_out = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const double to_rim = 1 - std::max(std::abs(input[i].x()), std::abs(input[i].y()));
    if (to_rim > 0.7 * radius) continue;
    ++near;
    if (!represents_itself(points, i)) ++left_out;
  }
  EXPECT_LE(left_out, near / 200) << "of " << near;
}

TEST(PlaneThinning, KeepsAllPointsWithinHalfARadiusOfACrease)
{
  const double radius = 3 * interval_of(4);
  for (const double slope : {0.6, 1.0, 3.0}) {  // 62, 90, 143 degrees
    const Points input = square([slope](double x, double y) { return Eigen::Vector3d(x, y, slope * std::abs(x)); });
    const pds::OrderedPoints points = thin_for_area(input, 4 * std::hypot(1.0, slope));
    ASSERT_GT(points.thinned_points, 0U) << slope;
    for (std::size_t i = 0; i < count; ++i) {
      const bool near = std::abs(input[i].x()) < 0.5 * radius;
      EXPECT_TRUE(!near || represents_itself(points, i)) << slope;
    }
  }
}

TEST(PlaneThinning, KeepsAllPointsOfSheetsWithinARadiusOfEachOther)
{
  const double radius = 3 * interval_of(8);
  for (const double distance : {0.2, 1.0 / 3, 0.5, 0.7, 1.0}) {
    int side = 0;
    const Points input = square([&](double x, double y) {
      return Eigen::Vector3d(x, y, 0.2 * x - 0.5 * y + (++side % 2 == 0 ? 0.0 : distance * radius * std::sqrt(1.29)));
    });
    EXPECT_EQ(thin_for_area(input, 8 * std::sqrt(1.29)).thinned_points, 0U) << distance;
  }
}

TEST(PlaneThinning, KeepsNoisyPoints)
{
  Random noise(9);
  const double interval = interval_of(4);
  const auto sheet = [&](double deviation) {
    return square([&, deviation](double x, double y) { return Eigen::Vector3d(x, y, deviation * noise.normal()); });
  };
  EXPECT_EQ(thin_for_area(sheet(0.15 * interval), 4).thinned_points, 0U);
  EXPECT_GT(thin_for_area(sheet(0.05 * interval), 4).thinned_points, 0U);
}

TEST(PlaneThinning, KeepsPointsOfSurfacesThatBendWithinARadius)
{
  const Points small_balls = [] {
    Points points;
    const Points ball = sphere(count / 100);
    for (int n = 0; n < 100; ++n)
      for (const Eigen::Vector3d& p : ball) points.push_back(p + 5 * Eigen::Vector3d(n % 10, n / 10 % 10, 0));
    return points;
  }();
  EXPECT_EQ(thin(small_balls, 1.0, 0.05).thinned_points, 0U);
}

TEST(PlaneThinning, DependsNeitherOnTheInputOrderNorOnThreads)
{
  Points input = joined(flat_square(), flat_square());
  const double interval = interval_of(4);
  const pds::OrderedPoints first = thin(input, 3 * interval, 0.1 * interval, 1);
  Random(5).shuffle(input);
  const pds::OrderedPoints second = thin(input, 3 * interval, 0.1 * interval, 3);
  ASSERT_GT(first.thinned_points, 0U);
  EXPECT_EQ(first.position, second.position);
  EXPECT_EQ(first.merged_points, count);
}

TEST(PlaneThinning, DoesNotMindStrays)
{
  for (const double far : {1e3, 1e6, 1e8}) {
    const Points input = joined(flat_square(), {Eigen::Vector3d(far, -far, far)});
    const pds::OrderedPoints points = thin_for_area(input, 4);
    EXPECT_GT(points.thinned_points, count * 30 / 100) << far;
    EXPECT_TRUE(represents_itself(points, count)) << far;
  }
}

TEST(PlaneThinning, LeavesSmallCloudsAndOddRadiiAlone)
{
  const Points input = flat_square();
  EXPECT_EQ(thin(plane(pds::fewest_points_to_thin_planes - 1), 0.1, 0.01).thinned_points, 0U);
  for (const double radius : {0.0, 1e-30, 10.0, std::numeric_limits<double>::infinity()})
    EXPECT_EQ(thin(input, radius, 0.01).thinned_points, 0U) << radius;
}

/** \brief Few points in the midst beside many at the rim must not look like outliers. */
TEST(PlaneThinning, LosesNoPointsHoweverCoarseTheMesh)
{
  const Points input = flat_square();
  for (const double factor : {3.0, 5.0, 10.0, 30.0, 60.0}) {
    pds::Options options;
    options.radius_factor = factor;
    const pds::Reconstruction mesh = reconstruct(input, options);
    EXPECT_EQ(mesh.report.outliers, 0U) << factor;
    EXPECT_EQ(std::count(mesh.voronoi.label.begin(), mesh.voronoi.label.end(), pds::no_label), 0) << factor;
  }
}

/** \brief A fifth of the points is noisy, which is too little to smooth a cloud, though half of the others is left out.
 */
TEST(PlaneThinning, MakesNoCloudNoisy)
{
  Random noise(4);
  const double interval = interval_of(4);
  const Points input = square(
      [&](double x, double y) { return Eigen::Vector3d(x, y, x > 0.6 ? 0.4 * interval * noise.normal() : 0.0); });
  for (const double factor : {3.0, 5.0, 10.0}) {
    pds::Options options;
    options.radius_factor = factor;
    EXPECT_FALSE(reconstruct(input, options).report.smoothed) << factor;
  }
}

TEST(SampledDistances, AreThoseOfTheWholeSearch)
{
  constexpr std::size_t k = 15;
  const pds::Parallel parallel(2);
  const pds::PointArray<Eigen::Vector3f> position = pds::order_points(view_of(torus(count)), parallel).position;
  const pds::PointArray<std::uint32_t> rows = pds::nearest_neighbors(position, k, parallel);
  const pds::PointArray<pds::NeighborDistance> sample = pds::sample_neighbor_distances(position, k, parallel);
  ASSERT_GT(sample.size(), 5000U);
  ASSERT_LT(sample.size(), 20000U);
  EXPECT_LT(sample.front().point, 100U);
  EXPECT_GT(sample.back().point, count - 1000);
  for (const pds::NeighborDistance& found : sample) {
    double sum = 0;
    for (std::size_t j = 0; j < k; ++j)
      sum += static_cast<double>((position[rows[found.point * k + j]] - position[found.point]).norm());
    EXPECT_NEAR(static_cast<double>(found.mean), sum / k, 1e-5 * sum);
  }
}

}  // namespace
}  // namespace pds_test
