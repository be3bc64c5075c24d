// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/thinning.h>

#include <cmath>
#include <limits>
#include <map>
#include <vector>

#include "core_testing.h"

/** \brief Both ways of thinning: of points in order, and before they are brought into order. */
namespace pds_test
{
namespace
{

constexpr std::size_t count = 20000;
constexpr double side = 0.2;  // some ten points of the torus in a voxel

pds::OrderedPoints thinned_in_order(const Points& input, double voxel_side, unsigned threads)
{
  const pds::Parallel parallel(threads);
  pds::OrderedPoints points = pds::order_points(view_of(input), parallel);
  const double unit = points.unit;
  return pds::thin_points(std::move(points), voxel_side / unit, parallel);
}

pds::OrderedPoints thinned_before_order(const Points& input, double voxel_side, unsigned threads)
{
  return pds::order_and_thin_points(view_of(input), voxel_side, pds::Parallel(threads));
}

using Thin = pds::OrderedPoints (*)(const Points&, double, unsigned);

class Thinning : public testing::TestWithParam<Thin>
{
 protected:
  static pds::OrderedPoints thin(const Points& input, double voxel_side, unsigned threads = 2)
  {
    return GetParam()(input, voxel_side, threads);
  }
};

TEST_P(Thinning, LetsPointsOfTheInputRepresentAllThatAreNear)
{
  const Points input = torus(count);
  const pds::OrderedPoints points = thin(input, side);
  EXPECT_LT(points.size(), input.size() / 5);
  EXPECT_GT(points.size(), input.size() / 20);
  EXPECT_EQ(points.size() + points.thinned_points, input.size());
  ASSERT_EQ(points.rank_of_input.size(), input.size());
  for (std::size_t i = 0; i < input.size(); ++i) {
    const std::uint32_t rank = points.rank_of_input[i];
    ASSERT_LT(rank, points.size());
    EXPECT_LE((input[i] - input[points.input_index[rank]]).norm(), std::sqrt(3.0) * side);
  }
  for (std::uint32_t rank = 0; rank < points.size(); ++rank) {
    EXPECT_EQ(points.rank_of_input[points.input_index[rank]], rank);
    const Eigen::Vector3d local = (input[points.input_index[rank]] - points.origin) / points.unit;
    EXPECT_EQ(points.position[rank], local.cast<float>().eval());
  }
}

TEST_P(Thinning, KeepsThePointNearestToTheMean)
{
  const Points input = torus(count);
  const pds::OrderedPoints points = thin(input, side);
  std::vector<Eigen::Vector3d> mean(points.size(), Eigen::Vector3d::Zero());
  std::vector<std::size_t> represented(points.size());
  for (std::size_t i = 0; i < input.size(); ++i) {
    mean[points.rank_of_input[i]] += input[i];
    ++represented[points.rank_of_input[i]];
  }
  for (std::size_t i = 0; i < input.size(); ++i) {
    const std::uint32_t rank = points.rank_of_input[i];
    const Eigen::Vector3d middle = mean[rank] / static_cast<double>(represented[rank]);
    EXPECT_LE((input[points.input_index[rank]] - middle).norm(), (input[i] - middle).norm() + 1e-6);
  }
}

TEST_P(Thinning, DependsNeitherOnTheInputOrderNorOnThreads)
{
  Points input = joined(torus(count), torus(500));  // the second are coincident with some of the first
  const pds::OrderedPoints first = thin(input, side, 1);
  Random(5).shuffle(input);
  const pds::OrderedPoints second = thin(input, side, 3);
  EXPECT_EQ(first.position, second.position);
  EXPECT_EQ(first.thinned_points, second.thinned_points);
}

TEST_P(Thinning, CountsCoincidentPointsApart)
{
  const pds::OrderedPoints points = thin(joined(torus(count), torus(500)), side);
  EXPECT_EQ(points.merged_points, 500U);
  EXPECT_EQ(points.size() + points.thinned_points, count);
}

/** \brief Twice as many points in the same places are no reason to thin, nor to keep others. */
TEST_P(Thinning, DoesNotDependOnCoincidentPoints)
{
  for (const double voxel_side : {0.05, 0.1, side}) {
    const pds::OrderedPoints once = thin(torus(count), voxel_side);
    const pds::OrderedPoints twice = thin(joined(torus(count), torus(count)), voxel_side);
    EXPECT_EQ(once.position, twice.position) << voxel_side;
    EXPECT_EQ(once.thinned_points, twice.thinned_points) << voxel_side;
    EXPECT_EQ(twice.merged_points, count) << voxel_side;
  }
}

TEST_P(Thinning, LeavesFinePointsAsTheyAre)
{
  const Points input = torus(count);
  const pds::OrderedPoints points = thin(input, 0.02);
  EXPECT_EQ(points.size(), count);
  EXPECT_EQ(points.thinned_points, 0U);
  std::map<std::uint32_t, int> taken;
  for (const std::uint32_t i : points.input_index) ++taken[i];
  EXPECT_EQ(taken.size(), count);
}

TEST_P(Thinning, LeavesAThousandPointsHoweverLargeTheVoxels)
{
  for (const double huge : {10.0, 1e9}) {
    const std::size_t left = thin(torus(count), huge).size();
    EXPECT_GE(left, 1000U) << huge;
    EXPECT_LE(left, 10000U) << huge;
  }
  EXPECT_EQ(thin(torus(1999), 10).size(), 1999U);
}

TEST_P(Thinning, GoesWithVoxelsThatCannotBeNumbered)
{
  for (const double tiny : {1e-9, 1e-300}) EXPECT_EQ(thin(torus(count), tiny).size(), count) << tiny;
}

TEST_P(Thinning, SkipsPointsThatAreNotFinite)
{
  Points input = torus(count);
  input[7].y() = std::numeric_limits<double>::quiet_NaN();
  const pds::OrderedPoints points = thin(input, side);
  EXPECT_EQ(points.valid_points, count - 1);
  EXPECT_EQ(points.rank_of_input[7], pds::no_rank);
  EXPECT_EQ(points.size() + points.thinned_points, count - 1);
}

INSTANTIATE_TEST_SUITE_P(BothWays,
                         Thinning,
                         testing::Values(&thinned_in_order, &thinned_before_order),
                         [](const testing::TestParamInfo<Thin>& way) {
                           return way.index == 0 ? "InOrder" : "BeforeOrder";
                         });

/** \brief A place of many points, or one place for all, ends the search for a thousand voxels. */
TEST(ThinningBeforeOrder, TakesPointsInOnePlaceForOne)
{
  const pds::OrderedPoints points = thinned_before_order(Points(5000, Eigen::Vector3d(1, 2, 3)), side, 2);
  EXPECT_EQ(points.size(), 1U);
  EXPECT_EQ(points.merged_points, 4999U);
  EXPECT_EQ(points.thinned_points, 0U);
}

TEST(ThinningBeforeOrder, ThinsBesideAStray)
{
  Points input = torus(count);
  input.emplace_back(1e5, 0, 0);
  const pds::OrderedPoints points = thinned_before_order(input, side, 2);
  EXPECT_LT(points.size(), count / 5);
  EXPECT_EQ(points.size() + points.thinned_points, count + 1);
}

/** \brief All but one of the points are in one cell of the curve, however many bits tell voxels apart. */
TEST(ThinningBeforeOrder, KeepsAllPointsIfAStrayLeavesTooFewVoxels)
{
  Points input = torus(count);
  input.emplace_back(1e9, 0, 0);
  const pds::OrderedPoints points = thinned_before_order(input, 1e6, 2);
  EXPECT_EQ(points.size(), count + 1);
  EXPECT_EQ(points.thinned_points, 0U);
  EXPECT_EQ(points.position, pds::order_points(view_of(input), pds::Parallel(2)).position);
}

}  // namespace
}  // namespace pds_test
