// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <numeric>

#include "core_testing.h"

/** \brief Vertices that are placed where the mesh fits the points best. */
namespace pds_test
{
namespace
{

constexpr std::size_t cloud_size = 20000;

pds::Options quadric_options()
{
  pds::Options options;
  options.placement = pds::Placement::quadric;
  return options;
}

/** \brief Mean distance of the faces' centroids from a surface. */
template <typename Distance>
double mean_distance(const pds::Reconstruction& mesh, const Points& vertices, const Distance& distance)
{
  double sum = 0;
  for (const auto& t : mesh.triangles)
    sum += std::abs(distance((vertices[t[0]] + vertices[t[1]] + vertices[t[2]]) / 3.0));
  return sum / static_cast<double>(mesh.triangles.size());
}

double distance_from_torus(const Eigen::Vector3d& p)
{
  return std::hypot(std::hypot(p.x(), p.y()) - 1, p.z()) - torus_tube;
}

double distance_from_cube(const Eigen::Vector3d& p)
{
  const Eigen::Vector3d outside = p.cwiseAbs() - Eigen::Vector3d::Ones();
  const double largest = outside.maxCoeff();
  return largest > 0 ? outside.cwiseMax(0.0).norm() : largest;
}

TEST(Placement, LeavesPointsAloneByDefault)
{
  const pds::Reconstruction mesh = reconstruct(torus(cloud_size));
  EXPECT_TRUE(mesh.moved.position.empty());
  EXPECT_TRUE(mesh.moved.cell_point.empty());
}

TEST(Placement, MovesOnlyTheVertices)
{
  const Points points = joined(torus(cloud_size), saddle(8000));
  const pds::Reconstruction on_points = reconstruct(points);
  const pds::Reconstruction mesh = reconstruct(points, quadric_options());
  EXPECT_EQ(mesh.seeds, on_points.seeds);
  EXPECT_EQ(mesh.triangles, on_points.triangles);
  EXPECT_EQ(mesh.voronoi.label, on_points.voronoi.label);
  ASSERT_EQ(mesh.moved.position.size(), mesh.report.vertices);
  ASSERT_EQ(mesh.moved.cell_begin.size(), mesh.report.vertices + 1);
  EXPECT_EQ(mesh.moved.cell_begin.back(), mesh.moved.cell_point.size());
  for (std::size_t v = 0; v < mesh.report.vertices; ++v)
    for (std::size_t i = mesh.moved.cell_begin[v]; i < mesh.moved.cell_begin[v + 1]; ++i)
      EXPECT_EQ(mesh.voronoi.label[mesh.moved.cell_point[i]], v);
}

TEST(Placement, HalvesTheErrorOfSmoothAndSharpShapes)
{
  const Points smooth = torus(cloud_size);
  const pds::Reconstruction ring = reconstruct(smooth, quadric_options());
  EXPECT_LT(mean_distance(ring, ring.moved.position, distance_from_torus),
            0.5 * mean_distance(ring, vertex_positions(ring, smooth), distance_from_torus));
  const Points sharp = cube(cloud_size);
  const pds::Reconstruction box = reconstruct(sharp, quadric_options());
  EXPECT_LT(mean_distance(box, box.moved.position, distance_from_cube),
            0.5 * mean_distance(box, vertex_positions(box, sharp), distance_from_cube));
}

/** \brief The gentler a crease, the less the faces beside it show of the way into it; but all points agree on it. */
TEST(Placement, SlidesIntoGentleCreases)
{
  constexpr double slope = 0.09;  // on either side: the surface turns by 10 degrees
  Random random(11);
  Points roof;
  for (std::size_t i = 0; i < cloud_size; ++i) {
    const double x = random.uniform(-1, 1);
    roof.emplace_back(x, random.uniform(-1, 1), -slope * std::abs(x));
  }
  const auto distance = [&](const Eigen::Vector3d& p) { return p.z() + slope * std::abs(p.x()); };
  const pds::Reconstruction mesh = reconstruct(roof, quadric_options());
  const double on_points = mean_distance(mesh, vertex_positions(mesh, roof), distance);
  const double placed = mean_distance(mesh, mesh.moved.position, distance);
  std::cout << placed / on_points << " of the distance is left\n";
  EXPECT_LT(placed, 0.35 * on_points);
}

TEST(Placement, IsInTheMiddleOfNoise)
{
  Points points = torus(large_cloud);
  Random random(5);
  double noise = 0;
  for (Eigen::Vector3d& p : points) {
    p += 0.01 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
    noise += std::abs(distance_from_torus(p)) / static_cast<double>(large_cloud);
  }
  const pds::Reconstruction mesh = reconstruct(points, quadric_options());
  EXPECT_LT(mean_distance(mesh, mesh.moved.position, distance_from_torus), 0.35 * noise);
}

TEST(Placement, FoldsNothingAndStaysInTheCell)
{
  Points noisy = cube(cloud_size);
  Random random(7);
  for (Eigen::Vector3d& p : noisy) p += random.in_box(0.02);
  for (const Points& points : {cube(cloud_size), two_holed_plate(cloud_size), noisy}) {
    const pds::Reconstruction mesh = reconstruct(points, quadric_options());
    const MeshFacts facts = examine(mesh.triangles, mesh.moved.position);
    EXPECT_EQ(facts.folded_edges, 0U);
    EXPECT_EQ(facts.degenerate_faces, 0U);
    const Points seeds = vertex_positions(mesh, points);
    for (const auto& t : mesh.triangles)
      for (std::size_t i = 0; i < 3; ++i)
        EXPECT_LE((mesh.moved.position[t[i]] - seeds[t[i]]).norm(),
                  0.5001 * (seeds[t[(i + 1) % 3]] - seeds[t[i]]).norm());
  }
}

TEST(Placement, DependsOnNeitherThreadsNorInputOrder)
{
  const Points points = joined(cube(8000), torus(8000));
  pds::Options options = quadric_options();
  options.threads = 1;
  const pds::Reconstruction reference = reconstruct(points, options);
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0U);
  Random(3).shuffle(order);
  Points shuffled;
  for (const std::uint32_t i : order) shuffled.push_back(points[i]);
  options.threads = 3;
  const pds::Reconstruction other = reconstruct(shuffled, options);
  EXPECT_EQ(other.moved.position, reference.moved.position);
  EXPECT_EQ(other.moved.cell_begin, reference.moved.cell_begin);
  ASSERT_EQ(other.moved.cell_point.size(), reference.moved.cell_point.size());
  for (std::size_t i = 0; i < other.moved.cell_point.size(); ++i)
    EXPECT_EQ(order[other.moved.cell_point[i]], reference.moved.cell_point[i]);
}

TEST(Placement, FollowsMotionsAndUnits)
{
  const Points points = torus(cloud_size);
  const Eigen::AngleAxisd turn(1.1, Eigen::Vector3d(1, -2, 0.5).normalized());
  Points moved;
  for (const Eigen::Vector3d& p : points) moved.emplace_back(1000 * (turn * p) + Eigen::Vector3d(5e5, 5e6, 0));
  const pds::Reconstruction mesh = reconstruct(moved, quadric_options());
  Points back;
  for (const Eigen::Vector3d& p : mesh.moved.position)
    back.emplace_back(turn.inverse() * (p - Eigen::Vector3d(5e5, 5e6, 0)) / 1000);
  const pds::Reconstruction reference = reconstruct(points, quadric_options());
  EXPECT_NEAR(mean_distance(mesh, back, distance_from_torus),
              mean_distance(reference, reference.moved.position, distance_from_torus), 3e-4);
}

}  // namespace
}  // namespace pds_test
