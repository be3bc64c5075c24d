// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <numeric>

#include "core_testing.h"

/** \brief What must not change the mesh, or not make it worse: order, threads, place, size, unit. */
namespace pds_test
{
namespace
{

/** \brief A cloud with everything in it: smooth and sharp parts, an open one, coincident points, a NaN. */
Points mixed_cloud()
{
  Points points = joined(torus(8000), torus(300));
  for (const Eigen::Vector3d& p : cube(6000)) points.push_back(0.3 * p + Eigen::Vector3d(3, 0, 0));
  for (const Eigen::Vector3d& p : saddle(6000)) points.push_back(p - Eigen::Vector3d(0, 0, 2));
  points.emplace_back(std::nan(""), 0, 0);
  return points;
}

pds::Options options_of(double adaptive, unsigned threads)
{
  pds::Options options;
  options.adaptive = adaptive;
  options.threads = threads;
  return options;
}

class Invariance : public testing::TestWithParam<double>
{
};

INSTANTIATE_TEST_SUITE_P(Metrics, Invariance, testing::Values(0.0, 0.25), [](const auto& test) {
  return test.param == 0 ? "uniform" : "adaptive";
});

TEST_P(Invariance, ThreadsDoNotChangeAnything)
{
  const Points points = mixed_cloud();
  const pds::Reconstruction one = reconstruct(points, options_of(GetParam(), 1));
  EXPECT_GT(one.triangles.size(), 1000U);
  for (const unsigned threads : {2U, 3U, 8U}) {
    const pds::Reconstruction other = reconstruct(points, options_of(GetParam(), threads));
    EXPECT_EQ(other.report.threads, threads);
    EXPECT_EQ(other.seeds, one.seeds);
    EXPECT_EQ(other.triangles, one.triangles);
    EXPECT_EQ(other.voronoi.label, one.voronoi.label);
    EXPECT_EQ(other.witness_points, one.witness_points);
    EXPECT_EQ(other.seed_edges, one.seed_edges);
    EXPECT_EQ(other.boundary_loops, one.boundary_loops);
    EXPECT_EQ(other.report.radius, one.report.radius);
  }
}

TEST_P(Invariance, InputOrderDoesNotChangeTheMesh)
{
  const Points points = mixed_cloud();
  const pds::Reconstruction reference = reconstruct(points, options_of(GetParam(), 2));
  const Points vertices = vertex_positions(reference, points);
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    std::vector<std::uint32_t> order(points.size());
    std::iota(order.begin(), order.end(), 0U);
    Random(seed).shuffle(order);
    Points shuffled;
    for (const std::uint32_t i : order) shuffled.push_back(points[i]);
    const pds::Reconstruction other = reconstruct(shuffled, options_of(GetParam(), 2));
    EXPECT_EQ(vertex_positions(other, shuffled), vertices);
    EXPECT_EQ(other.triangles, reference.triangles);
    EXPECT_EQ(other.seed_edges, reference.seed_edges);
    EXPECT_EQ(other.boundary_loops, reference.boundary_loops);
    for (std::size_t i = 0; i < order.size(); ++i) ASSERT_EQ(other.voronoi.label[i], reference.voronoi.label[order[i]]);
  }
}

TEST_P(Invariance, ARunRepeatsItself)
{
  const Points points = mixed_cloud();
  const pds::Reconstruction first = reconstruct(points, options_of(GetParam(), 0));
  const pds::Reconstruction second = reconstruct(points, options_of(GetParam(), 0));
  EXPECT_EQ(first.seeds, second.seeds);
  EXPECT_EQ(first.triangles, second.triangles);
}

TEST_P(Invariance, MotionsAndUnitsKeepTheMeshAsGood)
{
  const Points original = torus(20000);
  const pds::Reconstruction reference = reconstruct(original, options_of(GetParam(), 2));
  const Eigen::AngleAxisd turn(1.1, Eigen::Vector3d(1, -2, 0.5).normalized());
  const Eigen::Vector3d utm(500000.25, 5400000.5, 310);
  const Eigen::Affine3d motions[] = {
      Eigen::Affine3d(turn),
      Eigen::Translation3d(utm) * Eigen::Affine3d(turn),
      Eigen::Affine3d(Eigen::Scaling(1e-9)),
      Eigen::Affine3d(Eigen::Scaling(1e12)) * turn,
      Eigen::Affine3d(Eigen::Scaling(0.3)) * Eigen::Translation3d(0.1, 0.2, 0.3),
  };
  for (const Eigen::Affine3d& motion : motions) {
    SCOPED_TRACE(testing::PrintToString(motion.matrix().norm()));
    Points points;
    for (const Eigen::Vector3d& p : original) points.push_back(motion * p);
    const pds::Reconstruction mesh = reconstruct(points, options_of(GetParam(), 2));
    expect_closed(mesh, points, 1);
    const double expected = static_cast<double>(reference.report.vertices);
    EXPECT_NEAR(static_cast<double>(mesh.report.vertices), expected, 0.03 * expected);
    const double scale = std::cbrt(motion.linear().determinant());
    EXPECT_NEAR(mesh.report.radius / scale, reference.report.radius, 1e-3 * reference.report.radius);
  }
}

TEST_P(Invariance, APowerOfTwoOfTheUnitGivesTheSameMesh)
{
  const Points original = mixed_cloud();
  const pds::Reconstruction reference = reconstruct(original, options_of(GetParam(), 2));
  Points points = original;
  for (Eigen::Vector3d& p : points) p *= 1024;
  const pds::Reconstruction mesh = reconstruct(points, options_of(GetParam(), 2));
  EXPECT_EQ(mesh.seeds, reference.seeds);
  EXPECT_EQ(mesh.triangles, reference.triangles);
  EXPECT_EQ(mesh.report.radius, 1024 * reference.report.radius);
}

TEST(Results, AreAsDescribed)
{
  const Points points = mixed_cloud();
  const pds::Reconstruction mesh = reconstruct(points);
  const pds::Report& report = mesh.report;
  EXPECT_EQ(report.input_points, points.size());
  EXPECT_EQ(report.valid_points, points.size() - 1);
  EXPECT_EQ(report.merged_points, 300U);
  EXPECT_EQ(report.k, 15);
  EXPECT_EQ(report.radius, 3 * report.sampling_interval);
  EXPECT_GT(report.peak_rss_bytes, 0U);
  ASSERT_GE(report.stage_peaks.size(), 8U);
  EXPECT_EQ(report.stage_peaks.front().stage, "neighbors");
  for (std::size_t s = 1; s < report.stage_peaks.size(); ++s)
    EXPECT_GE(report.stage_peaks[s].rss_bytes, report.stage_peaks[s - 1].rss_bytes) << report.stage_peaks[s].stage;
  EXPECT_FALSE(report.version.empty());

  ASSERT_EQ(mesh.voronoi.label.size(), points.size());
  ASSERT_EQ(mesh.voronoi.distance.size(), points.size());
  EXPECT_EQ(mesh.voronoi.label.back(), pds::no_label);
  EXPECT_TRUE(std::isnan(mesh.voronoi.distance.back()));
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    ASSERT_LT(mesh.voronoi.label[i], mesh.seeds.size());
    const double straight = (points[i] - points[mesh.seeds[mesh.voronoi.label[i]]]).norm();
    ASSERT_GE(static_cast<double>(mesh.voronoi.distance[i]), straight - 1e-5 * report.radius);
    ASSERT_LE(static_cast<double>(mesh.voronoi.distance[i]), 1.00001 * report.radius);
  }
  for (std::uint32_t s = 0; s < mesh.seeds.size(); ++s) {
    EXPECT_EQ(mesh.voronoi.label[mesh.seeds[s]], s);
    EXPECT_EQ(mesh.voronoi.distance[mesh.seeds[s]], 0.0F);
  }
  EXPECT_TRUE(std::is_sorted(mesh.witness_points.begin(), mesh.witness_points.end()));
  EXPECT_GT(mesh.witness_points.size(), 500U);
}

TEST(Results, BoundaryLoopsRunAlongTheFaces)
{
  const Points points = saddle(10000);
  const pds::Reconstruction mesh = reconstruct(points);
  std::set<std::pair<std::uint32_t, std::uint32_t>> directed;
  for (const auto& t : mesh.triangles)
    for (std::size_t e = 0; e < 3; ++e) directed.emplace(t[e], t[(e + 1) % 3]);
  ASSERT_EQ(mesh.boundary_loops.size(), 1U);
  const auto& loop = mesh.boundary_loops.front();
  for (std::size_t i = 0; i < loop.size(); ++i) {
    EXPECT_EQ(directed.count({loop[i], loop[(i + 1) % loop.size()]}), 1U);
    EXPECT_EQ(directed.count({loop[(i + 1) % loop.size()], loop[i]}), 0U);
  }
}

}  // namespace
}  // namespace pds_test
