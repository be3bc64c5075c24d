// SPDX-License-Identifier: BSD-3-Clause
#include <functional>
#include <iostream>
#include <utility>

#include "core_testing.h"
#include "crease_cover.h"

/** \brief Whole runs on shapes whose topology and area are known, for the parameters that the project promises. */
namespace pds_test
{
namespace
{

struct Shape
{
  const char* name;
  Points (*sample)(std::size_t count, std::uint64_t seed);
  long long genus;  ///< of a closed shape
  double area;      ///< 0 = not compared, because the mesh cuts sharp edges
  double volume;

  friend void PrintTo(const Shape& shape, std::ostream* stream) { *stream << shape.name; }
};

struct Setting
{
  double factor;
  int k;
  double adaptive;
};

const Shape closed_shapes[] = {
    {"sphere", sphere, 0, 4 * pi, 4 * pi / 3},
    {"torus", torus, 1, 4 * pi* pi* torus_tube, 2 * pi* pi* torus_tube* torus_tube},
    {"cube", cube, 0, 0, 8},
    {"cylinder", cylinder, 0, 0, pi* cylinder_radius* cylinder_radius* cylinder_height},
    {"two_holed_plate", two_holed_plate, 2, 0, 13},
};

Points plane_at_zero(std::size_t count, std::uint64_t seed) { return plane(count, 0, seed); }

const Shape open_shapes[] = {
    {"plane", plane_at_zero, 0, 4, 0},
    {"saddle", saddle, 0, 0, 0},
    {"swiss_roll", swiss_roll, 0, 0, 0},
};

pds::Options options_of(const Setting& setting)
{
  pds::Options options;
  options.radius_factor = setting.factor;
  options.k_neighbors = setting.k;
  options.adaptive = setting.adaptive;
  return options;
}

std::string text_of(const Setting& setting)
{
  return "factor " + std::to_string(setting.factor) + ", k " + std::to_string(setting.k) + ", adaptive " +
         std::to_string(setting.adaptive);
}

template <typename Test>
std::string name_of(const Test& test)
{
  return test.param.name;
}

class ClosedShape : public testing::TestWithParam<Shape>
{
 protected:
  static void expect_right(std::size_t count, double adaptive)
  {
    const Shape& shape = GetParam();
    const Points points = shape.sample(count, 1);
    pds::Options options;
    options.adaptive = adaptive;
    const pds::Reconstruction mesh = reconstruct(points, options);
    const MeshFacts facts = expect_closed(mesh, points, shape.genus);
    if (shape.area > 0) {
      EXPECT_NEAR(facts.area, shape.area, 0.01 * shape.area);
    }
    EXPECT_NEAR(facts.volume, shape.volume, 0.03 * shape.volume);
    EXPECT_EQ(count_piercing_edges(mesh.triangles, vertex_positions(mesh, points)), 0U);
  }
};

INSTANTIATE_TEST_SUITE_P(Shapes, ClosedShape, testing::ValuesIn(closed_shapes), name_of<testing::TestParamInfo<Shape>>);

TEST_P(ClosedShape, IsClosedOutwardAndOfTheRightGenus)
{
  for (const std::size_t count : {small_cloud, large_cloud})
    for (const double adaptive : {0.0, 0.25}) {
      SCOPED_TRACE(std::to_string(count) + " points, adaptive " + std::to_string(adaptive));
      expect_right(count, adaptive);
    }
}

TEST(SharpShapes, HaveEdgesOfTheMeshAlongTheirEdges)
{
  constexpr double least_turn = 20;  // degrees: half of an edge's 90 if vertices lie on either side of it, less some
  Creases edges;
  for (int axis = 0; axis < 3; ++axis)
    for (const double u : {-1.0, 1.0})
      for (const double v : {-1.0, 1.0}) {
        Eigen::Vector3d from(u, v, -1);
        Eigen::Vector3d to(u, v, 1);
        std::swap(from[axis], from[2]);
        std::swap(to[axis], to[2]);
        edges.from.push_back(from);
        edges.to.push_back(to);
      }
  const Points points = cube(large_cloud);
  const pds::Reconstruction mesh = reconstruct(points);
  const Creases creases = find_creases(mesh.triangles, vertex_positions(mesh, points), least_turn);
  const double share = covered_share(edges, creases, mesh.report.radius / 4);
  EXPECT_GE(share, 0.9);
  std::cout << share << " of the edges\n";
}

TEST_P(ClosedShape, IsSoundForEveryFactorAndK)
{
  const Points points = GetParam().sample(10000, 2);
  for (const double factor : {2.3, 3.0, 6.0})
    for (const int k : {10, 15, 30})
      for (const double adaptive : {0.0, 0.25}) {
        const Setting setting{factor, k, adaptive};
        SCOPED_TRACE(text_of(setting));
        EXPECT_GT(expect_sound(reconstruct(points, options_of(setting)), points).faces, 50U);
      }
}

TEST_P(ClosedShape, IsSoundWithEitherSolver)
{
  const Points points = GetParam().sample(20000, 3);
  pds::Options options;
  options.geodesic_solver = pds::GeodesicSolver::dijkstra;
  const pds::Reconstruction mesh = reconstruct(points, options);
  expect_closed(mesh, points, GetParam().genus);
  EXPECT_GT(mesh.report.seeds, reconstruct(points).report.seeds) << "paths along edges are longer, so disks smaller";
}

class OpenShape : public testing::TestWithParam<Shape>
{
};

INSTANTIATE_TEST_SUITE_P(Shapes, OpenShape, testing::ValuesIn(open_shapes), name_of<testing::TestParamInfo<Shape>>);

TEST_P(OpenShape, HasOneLoop)
{
  for (const std::size_t count : {small_cloud, large_cloud})
    for (const double adaptive : {0.0, 0.25}) {
      SCOPED_TRACE(std::to_string(count) + " points, adaptive " + std::to_string(adaptive));
      const Points points = GetParam().sample(count, 1);
      pds::Options options;
      options.adaptive = adaptive;
      const pds::Reconstruction mesh = reconstruct(points, options);
      const MeshFacts facts = expect_sound(mesh, points);
      EXPECT_EQ(facts.boundary_loops, 1U);
      EXPECT_EQ(facts.components, 1U);
      EXPECT_EQ(facts.euler(), 1);
      EXPECT_TRUE(mesh.report.orientable);
    }
}

TEST_P(OpenShape, IsSoundForEveryFactorAndK)
{
  const Points points = GetParam().sample(10000, 2);
  for (const double factor : {2.3, 3.0, 6.0})
    for (const int k : {10, 15, 30})
      for (const double adaptive : {0.0, 0.25}) {
        const Setting setting{factor, k, adaptive};
        SCOPED_TRACE(text_of(setting));
        EXPECT_GT(expect_sound(reconstruct(points, options_of(setting)), points).faces, 50U);
      }
}

TEST(OpenShapes, APlaneFacesUpAndIsCovered)
{
  const Points points = plane(20000);
  const MeshFacts facts = expect_sound(reconstruct(points), points);
  EXPECT_GT(facts.area, 0.9 * 4) << "the rim lies within a radius of the square's sides";
  EXPECT_LT(facts.area, 4.0);
  const pds::Reconstruction mesh = reconstruct(points);
  for (const auto& t : mesh.triangles) {
    const Points v = vertex_positions(mesh, points);
    EXPECT_GT((v[t[1]] - v[t[0]]).cross(v[t[2]] - v[t[0]]).z(), 0.0);
    if (&t - mesh.triangles.data() > 50) break;
  }
}

TEST(OpenShapes, APlaneEndsWhereItsPointsEnd)
{
  const Points points = plane(large_cloud);
  const pds::Reconstruction mesh = reconstruct(points);
  const Creases rim = find_rims(mesh.triangles, vertex_positions(mesh, points));
  Creases sides;
  sides.from = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  sides.to = {{1, -1, 0}, {1, 1, 0}, {-1, 1, 0}, {-1, -1, 0}};
  const double share = covered_share(sides, rim, mesh.report.radius / 4);
  std::cout << share << " of the sides are within a quarter of a radius of the rim\n";
  EXPECT_GE(share, 0.8);
}

TEST(OpenShapes, AMoebiusStripIsCutNotTorn)
{
  for (const std::size_t count : {small_cloud, large_cloud})
    for (const double adaptive : {0.0, 0.25}) {
      SCOPED_TRACE(std::to_string(count) + " points, adaptive " + std::to_string(adaptive));
      const Points points = moebius_strip(count);
      pds::Options options;
      options.adaptive = adaptive;
      const pds::Reconstruction mesh = reconstruct(points, options);
      const MeshFacts facts = expect_sound(mesh, points);
      EXPECT_FALSE(mesh.report.orientable);
      EXPECT_GE(static_cast<double>(facts.largest_component), 0.95 * static_cast<double>(facts.faces));
    }
}

TEST(OpenShapes, TwoSheetsStayApart)
{
  for (const std::size_t count : {20000U, 50000U}) {
    const Points lower = plane(count);
    const double gap = 3 * reconstruct(lower).report.sampling_interval;
    const Points points = joined(lower, plane(count, gap, 2));
    const pds::Reconstruction mesh = reconstruct(points);
    const MeshFacts facts = expect_sound(mesh, points);
    EXPECT_EQ(facts.components, 2U);
    EXPECT_EQ(facts.boundary_loops, 2U);
  }
}

TEST(OpenShapes, AHoleWiderThanTheLimitStaysOpenAndASmallerOneIsFilled)
{
  Points points;
  for (const Eigen::Vector3d& p : plane(40000))
    if (p.norm() > 0.5) points.push_back(p);
  EXPECT_EQ(expect_sound(reconstruct(points), points).boundary_loops, 2U) << "a perimeter of 34 radii";

  Points punched;
  const double radius = reconstruct(plane(40000)).report.radius;
  for (const Eigen::Vector3d& p : plane(40000))
    if (p.norm() > radius) punched.push_back(p);
  EXPECT_EQ(expect_sound(reconstruct(punched), punched).boundary_loops, 1U);
}

}  // namespace
}  // namespace pds_test
