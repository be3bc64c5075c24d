// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <pcl_pds_recon/deviation.h>

#include "meshes.h"

#include <Eigen/Geometry>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

namespace pds
{
namespace
{

constexpr double within = 1e-3;  // of theory: 0.1 %

void expect_all(const Distribution& found, double value)
{
  for (const double figure : {found.mean, found.rms, found.median, found.p95, found.p99, found.max})
    EXPECT_NEAR(figure, value, within * value);
}

TEST(Deviation, OfTheUnitSphereFromOneOfRadius101)
{
  const TriangleMesh inner = make_sphere(1, 6);
  const TriangleMesh outer = make_sphere(1.01, 6);
  const Deviation found = measure_deviation(inner, outer);
  expect_all(found.mesh_to_reference, 0.01);
  expect_all(found.reference_to_mesh, 0.01);
  EXPECT_NEAR(found.hausdorff, 0.01, within * 0.01);
  EXPECT_NEAR(found.diagonal, 2.02 * std::sqrt(3.0), 1e-9);
  EXPECT_LT(found.normal_deviation->mean, 0.05);
  for (const double distance : found.vertex_deviation) EXPECT_NEAR(distance, -0.01, within * 0.01);
  for (const double distance : found.face_deviation) EXPECT_NEAR(distance, -0.01, within * 0.01);
  for (const double distance : measure_deviation(outer, inner).sample_deviation) ASSERT_GT(distance, 0.0099);
}

TEST(Deviation, OfAShiftedPlaneIsTheShift)
{
  const Deviation found = measure_deviation(make_plane(0.25, 10), make_plane(0, 7));
  expect_all(found.mesh_to_reference, 0.25);
  expect_all(found.reference_to_mesh, 0.25);
  EXPECT_EQ(found.normal_deviation->max, 0);
  for (const double distance : found.sample_deviation) ASSERT_NEAR(distance, 0.25, 1e-12);
}

TEST(SignedDistances, TellTheSideOfEachPoint)
{
  const TriangleMesh plane = make_plane(0, 10);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> found =
      signed_distances(plane, {{0.5, 0.5, 0.1}, {0.25, 0.5, -0.2}, {0.3, nan, 0.3}, {0.5, 0.25, 0}});
  ASSERT_EQ(found.size(), 4U);
  EXPECT_NEAR(found[0], 0.1, 1e-12);
  EXPECT_NEAR(found[1], -0.2, 1e-12);
  EXPECT_TRUE(std::isnan(found[2]));
  EXPECT_EQ(found[3], 0);
  for (const double distance : signed_distances(make_sphere(1, 6), make_sphere(1.01, 6).vertices, 3))
    ASSERT_NEAR(distance, 0.01, within * 0.01);
  EXPECT_TRUE(signed_distances(plane, {}).empty());
  EXPECT_THROW(static_cast<void>(signed_distances({}, {{0, 0, 0}})), InvalidInput);
}

TEST(Deviation, OfAPlaneShiftedSidewaysShowsAtItsRim)
{
  TriangleMesh shifted = make_plane(0, 10);
  for (Eigen::Vector3d& p : shifted.vertices) p.x() += 0.1;
  const Deviation found = measure_deviation(shifted, make_plane(0, 10));
  EXPECT_NEAR(found.mesh_to_reference.mean, 0.1 * 0.1 / 2, within * 0.005);
  EXPECT_NEAR(found.mesh_to_reference.rms, std::sqrt(0.1 * 0.1 * 0.1 / 3), within * 0.02);
  EXPECT_NEAR(found.mesh_to_reference.p95, 0.05, within * 0.05);
  EXPECT_EQ(found.mesh_to_reference.median, 0);
  EXPECT_NEAR(found.hausdorff, 0.1, 1e-12);  // at the vertices: samples lie inside
}

/** Mean of f over the unit square, by the midpoint rule. */
double mean_over_square(const std::function<double(double, double)>& f)
{
  constexpr int steps = 1000;
  double sum = 0;
  for (int j = 0; j < steps; ++j)
    for (int i = 0; i < steps; ++i) sum += f((i + 0.5) / steps, (j + 0.5) / steps);
  return sum / steps / steps;
}

TEST(Deviation, OfAPlaneFromACloud)
{
  constexpr int cells = 50;
  constexpr double height = 0.01;
  const Deviation found = measure_deviation(make_plane(0, 3), make_lattice_cloud(height, cells));
  expect_all(found.reference_to_mesh, height);
  const auto squared = [](double u, double v) {
    return height * height + ((u - 0.5) * (u - 0.5) + (v - 0.5) * (v - 0.5)) / cells / cells;
  };
  const double mean = mean_over_square([&](double u, double v) { return std::sqrt(squared(u, v)); });
  EXPECT_NEAR(found.mesh_to_reference.mean, mean, within * mean);
  const double rms = std::sqrt(mean_over_square(squared));
  EXPECT_NEAR(found.mesh_to_reference.rms, rms, within * rms);
  EXPECT_NEAR(found.mesh_to_reference.max, std::sqrt(squared(0, 0)), 1e-12);  // at a corner of the plane
  EXPECT_FALSE(found.normal_deviation);
  for (const double distance : found.sample_deviation) ASSERT_LT(distance, 0);  // the cloud is above the plane
}

TEST(Deviation, TakesSidesFromTheNormalsOfACloud)
{
  TriangleMesh cloud = make_lattice_cloud(0.01, 20);
  cloud.normals.assign(cloud.vertices.size(), Eigen::Vector3d(0, std::sin(0.3), -std::cos(0.3)));
  const Deviation found = measure_deviation(make_plane(0, 3), cloud);
  // changes.
  EXPECT_NEAR(found.normal_deviation->mean, 0.3 * 180 / 3.14159265358979, 1e-9);
  EXPECT_NEAR(found.normal_deviation->max, 0.3 * 180 / 3.14159265358979, 1e-9);
  const TriangleMesh below = make_plane(-1, 3);
  for (const double distance : measure_deviation(below, cloud).vertex_deviation) EXPECT_GT(distance, 1);
}

TEST(Deviation, PassesOverPointsOfACloudThatAreNotFinite)
{
  TriangleMesh cloud = make_lattice_cloud(0.01, 20);
  cloud.vertices.insert(cloud.vertices.begin() + 7, Eigen::Vector3d::Constant(std::nan("")));
  const Deviation found = measure_deviation(make_plane(0, 3), cloud);
  expect_all(found.reference_to_mesh, 0.01);
  EXPECT_TRUE(std::isfinite(found.mesh_to_reference.max));
}

TEST(Deviation, IsTheSameForAnyNumberOfThreads)
{
  const TriangleMesh mesh = make_sphere(1, 4);
  TriangleMesh reference = make_sphere(1.02, 5);
  for (Eigen::Vector3d& p : reference.vertices) p.x() *= 1.1;
  DeviationOptions options;
  options.samples = 30000;
  options.threads = 1;
  const Deviation one = measure_deviation(mesh, reference, options);
  options.threads = 5;
  const Deviation five = measure_deviation(mesh, reference, options);
  EXPECT_EQ(one.sample_deviation, five.sample_deviation);
  EXPECT_EQ(one.vertex_deviation, five.vertex_deviation);
  EXPECT_EQ(one.mesh_to_reference.mean, five.mesh_to_reference.mean);
  EXPECT_EQ(one.reference_to_mesh.rms, five.reference_to_mesh.rms);
  options.seed = 1;
  EXPECT_NE(one.sample_deviation, measure_deviation(mesh, reference, options).sample_deviation);
}

TEST(Deviation, DoesNotDependOnWhereTheSurfacesAre)
{
  TriangleMesh mesh = make_sphere(1, 4);
  TriangleMesh reference = make_sphere(1.01, 4);
  const Deviation near = measure_deviation(mesh, reference);
  const Eigen::Vector3d utm(500000, 5000000, 200);
  for (TriangleMesh* moved : {&mesh, &reference})
    for (Eigen::Vector3d& p : moved->vertices) p += utm;
  const Deviation far = measure_deviation(mesh, reference);
  EXPECT_NEAR(far.mesh_to_reference.mean, near.mesh_to_reference.mean, 1e-8);
  EXPECT_NEAR(far.hausdorff, near.hausdorff, 1e-8);
}

/** Distance from a triangle by dense search of its barycentric coordinates: independent of the code under test. */
double distance_by_search(const Eigen::Vector3d& p, const TriangleMesh& mesh)
{
  double least = std::numeric_limits<double>::infinity();
  constexpr int steps = 200;
  for (const auto& [a, b, c] : mesh.faces)
    for (int i = 0; i <= steps; ++i)
      for (int j = 0; i + j <= steps; ++j) {
        const Eigen::Vector3d q =
            (i * mesh.vertices[a] + j * mesh.vertices[b] + (steps - i - j) * mesh.vertices[c]) / steps;
        least = std::min(least, (p - q).norm());
      }
  return least;
}

TEST(Deviation, OfVerticesIsTheDistanceFromTheNearestTriangle)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto point = [&] { return Eigen::Vector3d(uniform(random), uniform(random), uniform(random)); };
  TriangleMesh reference;
  for (std::uint32_t f = 0; f < 8; ++f) {
    for (int corner = 0; corner < 3; ++corner) reference.vertices.push_back(point());
    reference.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  }
  TriangleMesh mesh;
  for (int i = 0; i < 60; ++i) mesh.vertices.emplace_back(1.5 * point());
  for (std::uint32_t f = 0; f < 20; ++f) mesh.faces.push_back({3 * f, 3 * f + 1, 3 * f + 2});
  const Deviation found = measure_deviation(mesh, reference);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    EXPECT_NEAR(std::abs(found.vertex_deviation[i]), distance_by_search(mesh.vertices[i], reference), 2e-3);
}

TEST(Deviation, KnowsTheInsideAtEdgesAndVertices)
{
  const TriangleMesh octahedron = make_sphere(1, 0);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-2, 2);
  TriangleMesh mesh;
  for (int i = 0; i < 3000; ++i) mesh.vertices.emplace_back(uniform(random), uniform(random), uniform(random));
  mesh.faces.push_back({0, 1, 2});
  const Deviation found = measure_deviation(mesh, octahedron);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    EXPECT_EQ(found.vertex_deviation[i] > 0, mesh.vertices[i].cwiseAbs().sum() > 1) << mesh.vertices[i].transpose();
}

TEST(Deviation, WorksWithASingleTriangle)
{
  TriangleMesh triangle;
  triangle.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.faces = {{0, 1, 2}};
  const Deviation found = measure_deviation(triangle, triangle);
  EXPECT_NEAR(found.hausdorff, 0, 1e-15);
}

TEST(Deviation, RefusesWhatItCannotMeasure)
{
  const TriangleMesh plane = make_plane(0, 2);
  const TriangleMesh cloud = make_lattice_cloud(0, 3);
  TriangleMesh flat = plane;
  for (Eigen::Vector3d& p : flat.vertices) p.x() = 0;
  TriangleMesh wrong = plane;
  wrong.faces.push_back({0, 1, 9999});
  TriangleMesh not_finite = plane;
  not_finite.vertices[0].x() = std::nan("");
  TriangleMesh huge = plane;
  for (Eigen::Vector3d& p : huge.vertices) p *= 1e200;
  for (const TriangleMesh& bad : {TriangleMesh(), cloud, flat, wrong, not_finite, huge})
    EXPECT_THROW(static_cast<void>(measure_deviation(bad, plane)), InvalidInput);
  for (const TriangleMesh& bad : {TriangleMesh(), flat, wrong, not_finite, huge})
    EXPECT_THROW(static_cast<void>(measure_deviation(plane, bad)), InvalidInput);
  DeviationOptions options;
  options.samples = 0;
  EXPECT_THROW(static_cast<void>(measure_deviation(plane, plane, options)), InvalidOption);
  options = {};
  options.threads = 5000;
  EXPECT_THROW(static_cast<void>(measure_deviation(plane, plane, options)), InvalidOption);
}

TEST(Deviation, PassesOverFacesWithoutArea)
{
  TriangleMesh mesh = make_plane(0.5, 4);
  mesh.faces.push_back({0, 0, 1});
  mesh.faces.push_back({0, 1, 2});  // on a line
  const Deviation found = measure_deviation(mesh, make_plane(0, 4));
  expect_all(found.mesh_to_reference, 0.5);
  expect_all(measure_deviation(make_plane(0, 4), mesh).mesh_to_reference, 0.5);
}

}  // namespace
}  // namespace pds
