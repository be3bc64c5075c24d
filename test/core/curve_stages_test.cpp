// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/curve_extraction.h>
#include <pcl_pds_recon/curve_shape.h>

#include "core_testing.h"
#include "curve_shapes.h"

namespace pds_test
{
namespace
{

using Seeds = std::vector<std::uint32_t>;

using pds::extract_curves;

TEST(CurveExtraction, ChainsAreOpenAndRingsClosed)
{
  const auto curves =
      extract_curves({{0, 1, 0, 1.5F}, {1, 4, 0, 1.5F}, {2, 3, 0, 1.5F}, {2, 5, 0, 1.5F}, {3, 5, 0, 1.5F}}, 7);
  ASSERT_EQ(curves.size(), 2U);
  EXPECT_EQ(curves[0].seeds, (Seeds{0, 1, 4}));
  EXPECT_FALSE(curves[0].closed);
  EXPECT_EQ(curves[1].seeds, (Seeds{2, 3, 5}));
  EXPECT_TRUE(curves[1].closed);
}

TEST(CurveExtraction, AWayOverAThirdSeedIsNoEdge)
{
  // A ring of five, with a shortcut over seed 1.
  const auto curves = extract_curves(
      {{0, 1, 0, 1.1F}, {1, 2, 0, 1.1F}, {0, 2, 0, 2.2F}, {2, 3, 0, 2.3F}, {3, 4, 0, 2.3F}, {0, 4, 0, 2.3F}}, 5);
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_EQ(curves[0].seeds, (Seeds{0, 1, 2, 3, 4}));
  EXPECT_TRUE(curves[0].closed);
}

TEST(CurveExtraction, NothingBranches)
{
  // Three arms that meet in seed 0: the two nearest stay.
  const auto curves = extract_curves({{0, 1, 0, 1.3F}, {0, 2, 0, 1.1F}, {0, 3, 0, 1.2F}}, 4);
  ASSERT_EQ(curves.size(), 1U);
  EXPECT_EQ(curves[0].seeds, (Seeds{2, 0, 3}));
}

TEST(PointComponents, AreTheConnectedPartsOfTheCloud)
{
  Points points = sphere(500);
  for (const Eigen::Vector3d& p : sphere(300, 2)) points.push_back(p + Eigen::Vector3d(20, 0, 0));
  const Stages stages(points);
  const pds::PointComponents parts = pds::find_components(stages.graph);
  ASSERT_EQ(parts.size(), 2U);
  EXPECT_EQ(parts.points_of(0).size() + parts.points_of(1).size(), points.size());
  for (std::size_t c = 0; c < 2; ++c)
    for (const std::uint32_t i : parts.points_of(c)) {
      EXPECT_EQ(parts.component[i], c);
      for (const std::uint32_t j : stages.graph.neighbors(i)) EXPECT_EQ(parts.component[j], c);
    }
}

std::vector<pds::LineScale> scales_of(const Stages& stages, const pds::LineLimits& limits = {})
{
  return pds::find_line_scales(stages.points, stages.graph, pds::find_components(stages.graph), limits,
                               stages.parallel);
}

TEST(LineScales, GoWithTheWidthOfTheNoise)
{
  double before = 0;
  for (const double deviation : {0.002, 0.004, 0.008, 0.016}) {
    const Stages stages(circle().sample(20000, deviation));
    const pds::LineScale scale = scales_of(stages).at(0);
    EXPECT_TRUE(scale.noisy);
    const double radius = scale.radius * stages.points.unit;
    EXPECT_GT(radius, 5 * deviation);
    EXPECT_LT(radius, 20 * deviation);
    EXPECT_GT(radius, before);
    EXPECT_EQ(scale.interval, scale.radius / 2);
    before = radius;
  }
}

TEST(LineScales, WithoutNoiseAreThatOfTheNeighbours)
{
  const Stages stages(circle().sample(20000, 0));
  const pds::LineScale scale = scales_of(stages).at(0);
  EXPECT_FALSE(scale.noisy);
  EXPECT_DOUBLE_EQ(scale.interval, stages.graph.sampling_interval);
}

TEST(LineScales, SurfacesHaveNone)
{
  for (const Points& points : {sphere(3000), plane(3000), cube(3000), torus(3000)})
    EXPECT_EQ(scales_of(Stages(points)).at(0).radius, 0);
}

TEST(LineScales, KeepWithinTheirLimits)
{
  const Stages stages(circle().sample(20000, 0.02));
  const double radius = scales_of(stages).at(0).radius;
  ASSERT_GT(radius, 0);
  const double intervals = radius / stages.graph.sampling_interval;
  EXPECT_EQ(scales_of(stages, {1.01 * intervals, 0}).at(0).radius, radius);
  EXPECT_EQ(scales_of(stages, {0.99 * intervals, 0}).at(0).radius, 0);
  EXPECT_EQ(scales_of(stages, {1.01 * intervals, 1000}).at(0).radius, 0);
}

TEST(CenterOnCurves, TakesMostOfTheNoiseAway)
{
  const double deviation = 0.005;
  Stages stages(circle().sample(20000, deviation));
  stages.points.position =
      pds::center_on_curves(stages.points, pds::find_components(stages.graph), scales_of(stages), stages.parallel);
  double sum = 0;
  for (const Eigen::Vector3f& p : stages.points.position) {
    const Eigen::Vector3d place = p.cast<double>() * stages.points.unit + stages.points.origin;
    sum += std::pow(std::hypot(place.x(), place.y()) - 1, 2) + std::pow(place.z(), 2);
  }
  EXPECT_LT(std::sqrt(sum / 20000), 0.3 * deviation);  // that of the points is 1.4
}

TEST(Ends, AreFoundOnOpenCurvesOnly)
{
  const std::vector<std::uint8_t> no_rank(5000);
  const Stages open(spiral().sample(5000, 0), 30);
  const auto ends = pds::find_ends(open.points, open.graph, no_rank, 0.01, open.parallel);
  ASSERT_EQ(ends.size(), 2U);
  for (const std::uint32_t end : ends) {
    const Eigen::Vector3d place = open.points.position[end].cast<double>() * open.points.unit + open.points.origin;
    EXPECT_LT(std::min((place - spiral().first()).norm(), (place - spiral().last()).norm()), 0.02);
  }
  const Stages closed(circle().sample(5000, 0), 30);
  EXPECT_TRUE(pds::find_ends(closed.points, closed.graph, no_rank, 0.01, closed.parallel).empty());
}

}  // namespace
}  // namespace pds_test
