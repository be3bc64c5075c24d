// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "core_testing.h"

namespace pds_test
{
namespace
{

pds::OrderedPoints ordered(const Points& points) { return pds::order_points(view_of(points), pds::Parallel(2)); }

TEST(OrderedPoints, MergesCoincidentPointsIntoTheFirst)
{
  const pds::OrderedPoints points = ordered({{1, 2, 3}, {0, 0, 0}, {1, 2, 3}, {1, 2, 3}, {0, 0, 1}});
  EXPECT_EQ(points.size(), 3U);
  EXPECT_EQ(points.valid_points, 5U);
  EXPECT_EQ(points.merged_points, 2U);
  EXPECT_EQ(points.rank_of_input[0], points.rank_of_input[2]);
  EXPECT_EQ(points.rank_of_input[0], points.rank_of_input[3]);
  EXPECT_EQ(points.input_index[points.rank_of_input[3]], 0U);
}

TEST(OrderedPoints, LetsTheRecordsDecideWhoRepresentsAPlace)
{
  const Points input(5, Eigen::Vector3d(1, 2, 3));
  const std::array<int, 5> intensity{7, 4, 9, 4, 8};
  pds::PointCloudView cloud = view_of(input);
  cloud.record_less = [&](std::uint32_t a, std::uint32_t b) { return intensity[a] < intensity[b]; };
  const pds::OrderedPoints points = pds::order_points(cloud, pds::Parallel(1));
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points.input_index[0], 1U) << "of the two of lowest intensity, the first";
}

TEST(OrderedPoints, SkipsPointsThatAreNotFinite)
{
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  constexpr double inf = std::numeric_limits<double>::infinity();
  const pds::OrderedPoints points = ordered({{nan, 0, 0}, {0, 0, 0}, {0, inf, 0}, {1, 1, 1}, {0, 0, -inf}});
  EXPECT_EQ(points.size(), 2U);
  EXPECT_EQ(points.valid_points, 2U);
  EXPECT_EQ(points.merged_points, 0U);
  for (const std::size_t i : {0U, 2U, 4U}) EXPECT_EQ(points.rank_of_input[i], pds::no_label);
  for (const std::size_t i : {1U, 3U}) EXPECT_EQ(points.input_index[points.rank_of_input[i]], i);
}

TEST(OrderedPoints, TakesMinusZeroForZero)
{
  EXPECT_EQ(ordered({{0.0, 1, 1}, {-0.0, 1, 1}, {1, 0.0, 0.0}, {1, -0.0, 0.0}}).size(), 2U);
}

TEST(OrderedPoints, DoesNotDependOnTheInputOrder)
{
  Points input = joined(torus(3000), torus(500));  // the second are coincident with some of the first
  const pds::OrderedPoints first = ordered(input);
  EXPECT_EQ(first.size(), 3000U);
  Random(5).shuffle(input);
  const pds::OrderedPoints second = ordered(input);
  EXPECT_EQ(first.position, second.position);
  EXPECT_EQ(first.origin, second.origin);
  EXPECT_EQ(first.unit, second.unit);
}

TEST(OrderedPoints, DoesNotDependOnOrderOrThreadsWhereAStrayMakesCellsHuge)
{
  for (const double distance : {1e3, 1e5, 1e7}) {  // some points in a cell of the first curve; many; all
    Points input = joined(torus(30000), torus(2000));
    input.emplace_back(distance, 0, 0);
    input.emplace_back(std::nan(""), 0, 0);
    const pds::OrderedPoints first = ordered(input);
    Random(6).shuffle(input);
    const pds::OrderedPoints second = pds::order_points(view_of(input), pds::Parallel(3));
    EXPECT_EQ(first.position, second.position) << distance;
    EXPECT_EQ(first.merged_points, second.merged_points);
    for (std::size_t i = 0; i < input.size(); ++i) {
      if (!input[i].allFinite()) continue;
      const Eigen::Vector3d local = (input[i] - second.origin) / second.unit;
      EXPECT_EQ(second.position[second.rank_of_input[i]], local.cast<float>().eval());
    }
  }
}

TEST(OrderedPoints, PutsTheMedianAtTheOriginWhateverTheOrder)
{
  Random random(8);
  Points input;
  while (input.size() < 50001) input.emplace_back(random.normal(), std::exp(3 * random.normal()), random.below(3));
  Eigen::Vector3d median;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Eigen::Vector3d& p : input) values.push_back(p[axis]);
    std::sort(values.begin(), values.end());
    median[axis] = values[values.size() / 2];
  }
  EXPECT_EQ(ordered(input).origin, median);
  // Ascending, descending, and with all of the points from which the library guesses the median on one side of it.
  const auto by_x = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a.x() < b.x(); };
  std::sort(input.begin(), input.end(), by_x);
  EXPECT_EQ(ordered(input).origin, median);
  std::reverse(input.begin(), input.end());
  EXPECT_EQ(ordered(input).origin, median);
  constexpr std::uint32_t golden = 2654435769U;
  std::set<std::size_t> guessed_from;
  for (std::uint32_t i = 0; i < 4096; ++i) guessed_from.insert((std::uint64_t{i * golden} * input.size()) >> 32);
  Points biased(input.size());
  std::size_t front = 0;
  std::size_t back = guessed_from.size();
  for (std::size_t i = 0; i < input.size(); ++i) biased[i] = input[guessed_from.count(i) != 0 ? front++ : back++];
  EXPECT_EQ(ordered(biased).origin, median);
}

TEST(OrderedPoints, KeepsMillimetresFarFromTheOrigin)
{
  Points input;
  for (int i = 0; i < 1000; ++i) input.emplace_back(5e6 + 0.001 * i, 4e6 - 0.002 * i, 100 + 0.001 * (i % 7));
  const pds::OrderedPoints points = ordered(input);
  EXPECT_EQ(points.size(), input.size());
  for (std::size_t i = 0; i < input.size(); ++i) {
    const Eigen::Vector3d local = points.position[points.rank_of_input[i]].cast<double>();
    const Eigen::Vector3d restored = points.origin + points.unit * local;
    constexpr double rounding = 2e-9;  // of a double of this size, twice
    EXPECT_LE((restored - input[i]).cwiseAbs().maxCoeff(), points.unit * std::ldexp(1.0, -26) + rounding);
  }
}

TEST(OrderedPoints, GivesTheSamePositionsAtAnyPowerOfTwo)
{
  const Points input = sphere(500);
  const pds::OrderedPoints reference = ordered(input);
  for (const int exponent : {-1000, -300, -30, 30, 300, 1000}) {
    Points scaled = input;
    for (Eigen::Vector3d& p : scaled) p *= std::ldexp(1.0, exponent);
    const pds::OrderedPoints points = ordered(scaled);
    EXPECT_EQ(points.position, reference.position) << "scaled by 2^" << exponent;
    EXPECT_EQ(points.unit, std::ldexp(reference.unit, exponent));
  }
}

TEST(OrderedPoints, FitsPositionsIntoTheUnitCube)
{
  for (const double scale : {1e-320, 1e-30, 0.7, 3.0, 1e30, 2e307}) {
    Points input = cube(200);
    for (Eigen::Vector3d& p : input) p *= scale;
    const pds::OrderedPoints points = ordered(input);
    float largest = 0;
    for (const Eigen::Vector3f& p : points.position) largest = std::max(largest, p.cwiseAbs().maxCoeff());
    EXPECT_LE(largest, 0.5F) << "scale " << scale;
    EXPECT_GE(largest, 0.124F) << "scale " << scale;  // at least half the extent, in a unit of up to four extents
  }
}

TEST(OrderedPoints, RefusesAnExtentThatOverflows)
{
  for (const double end : {8e307, 1e308})  // the power of two above the extent overflows; the extent does
    EXPECT_THROW(ordered({{-end, 0, 0}, {end, 0, 0}, {0, 1, 0}}), pds::InvalidInput) << end;
}

TEST(OrderedPoints, ReadsFloatAndDoubleAlike)
{
  const Points input = sphere(300);
  std::vector<Eigen::Vector3f> single;
  Points rounded;
  for (const Eigen::Vector3d& p : input) {
    single.push_back(p.cast<float>());
    rounded.push_back(single.back().cast<double>());
  }
  pds::PointCloudView cloud;
  cloud.size = single.size();
  cloud.positions = pds::Vector3View(single.front().data(), sizeof(Eigen::Vector3f));
  EXPECT_EQ(pds::order_points(cloud, pds::Parallel(1)).position, ordered(rounded).position);
}

TEST(OrderedPoints, TakesAnEmptyCloud)
{
  const pds::OrderedPoints points = ordered({});
  EXPECT_EQ(points.size(), 0U);
  EXPECT_EQ(points.valid_points, 0U);
}

}  // namespace
}  // namespace pds_test
