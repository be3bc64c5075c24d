// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>

#include "core_testing.h"
#include "curve_shapes.h"

/** \brief Curves and surfaces told apart. */
namespace pds_test
{
namespace
{

pds::Options options_of(pds::Dimension dimension, unsigned threads = 0)
{
  pds::Options options;
  options.dimension = dimension;
  options.threads = threads;
  return options;
}

class Mixed : public testing::Test
{
 protected:
  Mixed()
  {
    points = sphere(20000);
    for (const Eigen::Vector3d& p : circle({0, 0, 0}, {3, 0, 0}, {0, 3, 0}).sample(5000, 0.002)) points.push_back(p);
    points.emplace_back(std::nan(""), 0, 0);
    Random(7).shuffle(points);
  }
  Points points;
};

TEST_F(Mixed, ASphereAndARingAreEachWhatTheyAre)
{
  const pds::Reconstruction result = reconstruct(points, options_of(pds::Dimension::automatic));
  const pds::Report& report = result.report;
  EXPECT_EQ(report.curves, 1U);
  EXPECT_EQ(report.closed_curves, 1U);
  EXPECT_EQ(report.components, 2U);
  EXPECT_EQ(report.euler, 2);
  EXPECT_TRUE(report.closed);
  EXPECT_EQ(report.input_points, points.size());
  EXPECT_EQ(report.valid_points, points.size() - 1);
  EXPECT_EQ(report.vertices, result.seeds.size());
  EXPECT_EQ(report.edges, 3 * result.triangles.size() / 2 + result.segments.size());
  EXPECT_GT(report.curve_radius, 0);
  for (const auto& triangle : result.triangles)
    for (const std::uint32_t v : triangle) ASSERT_NEAR(points[result.seeds.at(v)].norm(), 1, 1e-9);
  for (const auto& segment : result.segments)
    for (const std::uint32_t v : segment) ASSERT_NEAR(points[result.seeds.at(v)].norm(), 3, 0.02);
}

TEST_F(Mixed, EachPartIsAsByItself)
{
  const pds::Reconstruction both = reconstruct(points, options_of(pds::Dimension::automatic));
  Points on_sphere, on_ring;
  for (const Eigen::Vector3d& p : points) (p.norm() > 2 ? on_ring : on_sphere).push_back(p);
  const pds::Reconstruction ball = reconstruct(on_sphere);
  const pds::Reconstruction ring = reconstruct(on_ring, options_of(pds::Dimension::curve));
  EXPECT_EQ(both.triangles, ball.triangles);
  ASSERT_EQ(both.segments.size(), ring.segments.size());
  const Points vertices = vertex_positions(both, points);
  Points expected = vertex_positions(ball, on_sphere);
  expected = joined(expected, vertex_positions(ring, on_ring));
  EXPECT_EQ(vertices, expected);
  for (std::size_t i = 0; i < ring.segments.size(); ++i)
    EXPECT_EQ(both.segments[i][0], ring.segments[i][0] + ball.report.vertices);
  EXPECT_EQ(both.seed_edges.size(), ball.seed_edges.size() + ring.seed_edges.size());
  EXPECT_EQ(both.witness_points.size(), ball.witness_points.size() + ring.witness_points.size());
}

TEST_F(Mixed, LabelsNameTheSeedsOfThePartItself)
{
  const pds::Reconstruction result = reconstruct(points, options_of(pds::Dimension::automatic));
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!points[i].allFinite()) {
      EXPECT_EQ(result.voronoi.label[i], pds::no_label);
      continue;
    }
    const double straight = (points[i] - points[result.seeds.at(result.voronoi.label[i])]).norm();
    ASSERT_LE(straight, 1.1 * std::max(result.report.radius, result.report.curve_radius));
  }
}

TEST_F(Mixed, DoesNotDependOnThreadsOrOrder)
{
  const pds::Reconstruction one = reconstruct(points, options_of(pds::Dimension::automatic, 1));
  const pds::Reconstruction other = reconstruct(points, options_of(pds::Dimension::automatic, 4));
  EXPECT_EQ(other.seeds, one.seeds);
  EXPECT_EQ(other.triangles, one.triangles);
  EXPECT_EQ(other.segments, one.segments);
  Points shuffled = points;
  Random(8).shuffle(shuffled);
  const pds::Reconstruction third = reconstruct(shuffled, options_of(pds::Dimension::automatic));
  EXPECT_EQ(vertex_positions(third, shuffled), vertex_positions(one, points));
  EXPECT_EQ(third.triangles, one.triangles);
  EXPECT_EQ(third.segments, one.segments);
}

TEST_F(Mixed, StraysJoinNothing)
{
  Random random(5);
  for (int i = 0; i < 300; ++i) points.push_back(random.in_box(3.5));
  const pds::Reconstruction result = reconstruct(points, options_of(pds::Dimension::automatic));
  EXPECT_EQ(result.report.curves, 1U);
  EXPECT_EQ(result.report.closed_curves, 1U);
  EXPECT_TRUE(result.report.closed);
  EXPECT_EQ(result.report.components, 2U);
}

/** \brief A sheet within a ring, each point with the place of the sensor that saw it, below. */
TEST(Automatic, SurfacesFaceTheirViewpoints)
{
  Points points = circle({0, 0, 0}, {3, 0, 0}, {0, 3, 0}).sample(5000, 0.002);
  points = joined(points, plane(20000));
  const Points viewpoints(points.size(), {0, 0, -5});
  pds::PointCloudView cloud = view_of(points);
  cloud.viewpoints = pds::Vector3View(viewpoints.front().data(), sizeof(Eigen::Vector3d));
  const pds::Reconstruction result = pds::reconstruct(cloud, options_of(pds::Dimension::automatic));
  EXPECT_EQ(result.report.curves, 1U);
  ASSERT_FALSE(result.triangles.empty());
  const Points v = vertex_positions(result, points);
  for (const auto& t : result.triangles) ASSERT_LT((v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]).z(), 0.0);
}

TEST(Automatic, SurfacesAreMeshedAsEver)
{
  for (const Points& points : {sphere(10000), torus(10000), plane(10000), cube(10000), saddle(10000), swiss_roll(10000),
                               moebius_strip(10000), two_holed_plate(10000)}) {
    const pds::Reconstruction told = reconstruct(points, options_of(pds::Dimension::automatic));
    const pds::Reconstruction known = reconstruct(points);
    EXPECT_EQ(told.seeds, known.seeds);
    EXPECT_EQ(told.triangles, known.triangles);
    EXPECT_EQ(told.report.curves, 0U);
  }
}

}  // namespace
}  // namespace pds_test
