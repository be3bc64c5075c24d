// SPDX-License-Identifier: BSD-3-Clause
#include "surface_sampling.h"

#include "core_testing.h"

/** \brief Clouds whose points are rows or clumps at the reach of their neighbours are meshed at a larger one. */
namespace pds_test
{
namespace
{

bool is_surface(const Points& points, int k = 15)
{
  const Stages stages(points, k);
  return pds::is_sampled_as_surface(stages.graph, stages.parallel);
}

/** \brief A wavy surface over [0, 2] x [0, 1], scanned in rows. \param ratio distance of rows over that of points */
Points rows(double apart, double ratio)
{
  Random random(1);
  Points points;
  for (double x = 0; x <= 2; x += apart)
    for (double y = random.uniform(0, apart / ratio); y <= 1; y += apart / ratio)
      points.emplace_back(x, y, 0.1 * std::sin(4 * x) * std::cos(4 * y));
  return points;
}

/** \brief Each point so many times, by so much beside itself. */
Points repeated(const Points& once, unsigned times, double beside)
{
  Random random(2);
  Points points;
  for (const Eigen::Vector3d& p : once)
    for (unsigned time = 0; time < times; ++time) points.emplace_back(p + random.in_box(beside));
  return points;
}

/** \brief A unit sphere seen from its middle, along the same rays in every frame. \param noise of the range */
Points frames(std::size_t rays, unsigned count, double noise)
{
  Random random(3);
  Points points;
  for (const Eigen::Vector3d& ray : sphere(rays))
    for (unsigned frame = 0; frame < count; ++frame) points.emplace_back(ray * (1 + noise * random.normal()));
  return points;
}

TEST(SurfaceSampling, IsSeenWithNoiseOrWithout)
{
  EXPECT_TRUE(is_surface(sphere(small_cloud)));
  EXPECT_TRUE(is_surface(sphere(300)));
  EXPECT_TRUE(is_surface(plane(small_cloud)));
  EXPECT_TRUE(is_surface(repeated(sphere(small_cloud), 1, 0.05)));
  EXPECT_TRUE(is_surface(rows(0.01, 4)));
  for (const int k : {4, 8, 12, 30, 100}) EXPECT_TRUE(is_surface(plane(small_cloud), k)) << k;
}

TEST(SurfaceSampling, IsNotThatOfRowsAndClumps)
{
  EXPECT_FALSE(is_surface(rows(0.02, 20)));
  EXPECT_FALSE(is_surface(repeated(sphere(2000), 20, 1e-4)));
  EXPECT_FALSE(is_surface(frames(2000, 20, 0.01)));
  for (const int k : {12, 30}) EXPECT_FALSE(is_surface(rows(0.02, 80), k)) << k;
}

TEST(SparseRows, AreOneSurface)
{
  for (const double ratio : {12.0, 20.0, 40.0}) {
    SCOPED_TRACE(ratio);
    const Points points = rows(0.02, ratio);
    const MeshFacts facts = expect_sound(reconstruct(points), points);
    EXPECT_EQ(facts.components, 1U);
    EXPECT_EQ(facts.boundary_loops, 1U);
    EXPECT_GT(facts.area, 1.95);
  }
}

TEST(Clumps, AreOneSurface)
{
  for (const double beside : {1e-3, 1e-6}) {
    SCOPED_TRACE(beside);
    const Points points = repeated(torus(5000), 20, beside);
    expect_closed(reconstruct(points), points, 1);
  }
}

TEST(FramesOfASensorAtRest, AreOneSurface)
{
  for (const unsigned count : {10U, 30U}) {
    SCOPED_TRACE(count);
    const Points points = frames(5000, count, 0.01);  // a fifth of the rays' distance
    expect_closed(reconstruct(points), points, 0);
  }
}

TEST(Clumps, CountOnceForANumberOfVertices)
{
  pds::Options options;
  const Points points = repeated(torus(5000), 20, 1e-3);
  options.vertices = 300;
  EXPECT_NEAR(static_cast<double>(reconstruct(points, options).report.vertices), 300, 2);
  options.vertices = 1500;  // more than the least radius factor gives of 5000 points
  EXPECT_THROW(reconstruct(points, options), pds::InvalidInput);
}

TEST(ALine, StaysAsItIs)
{
  Points points;
  for (int i = 0; i < 5000; ++i) points.emplace_back(i, 0, 0);
  const double interval = (2 * (1 + 2 + 3 + 4 + 5 + 6 + 7) + 8) / 15.0;  // but at the ends
  EXPECT_NEAR(reconstruct(points).report.sampling_interval, interval, 0.01 * interval);
}

}  // namespace
}  // namespace pds_test
