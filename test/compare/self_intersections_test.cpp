// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <pcl_pds_recon/deviation.h>

#include "meshes.h"

#include <Eigen/Geometry>

namespace pds
{
namespace
{

std::size_t count(const std::vector<Eigen::Vector3d>& vertices, const std::vector<Triangle>& faces)
{
  TriangleMesh mesh;
  mesh.vertices = vertices;
  mesh.faces = faces;
  return count_self_intersections(mesh);
}

const std::vector<Eigen::Vector3d> triangle = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};

std::size_t count_with_triangle(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c)
{
  return count({triangle[0], triangle[1], triangle[2], a, b, c}, {{0, 1, 2}, {3, 4, 5}});
}

TEST(SelfIntersections, OfTwoTriangles)
{
  EXPECT_EQ(count_with_triangle({1, 1, -1}, {1, 1, 1}, {9, 9, 1}), 1U);      // an edge goes through
  EXPECT_EQ(count_with_triangle({5, 5, -1}, {5, 5, 1}, {9, 9, 1}), 0U);      // passes by
  EXPECT_EQ(count_with_triangle({1, 1, 1}, {2, 1, 1}, {1, 2, 1}), 0U);       // parallel
  EXPECT_EQ(count_with_triangle({1, 1, 0}, {1, 1, 1}, {2, 1, 1}), 1U);       // a corner touches
  EXPECT_EQ(count_with_triangle({1, 1, 1e-300}, {1, 1, 1}, {2, 1, 1}), 0U);  // nearly
  EXPECT_EQ(count_with_triangle({1, 1, 0}, {2, 1, 0}, {1, 2, 0}), 1U);       // in one plane, inside
  EXPECT_EQ(count_with_triangle({-1, -1, 0}, {9, -1, 0}, {-1, 9, 0}), 1U);   // in one plane, around
  EXPECT_EQ(count_with_triangle({5, 5, 0}, {9, 5, 0}, {5, 9, 0}), 0U);       // in one plane, apart
}

TEST(SelfIntersections, OfTrianglesThatShareAVertex)
{
  EXPECT_EQ(count_with_triangle({0, 0, 0}, {1, 1, 1}, {1, 1, -1}), 1U);      // through the face
  EXPECT_EQ(count_with_triangle({0, 0, 0}, {9, 9, 1}, {9, 9, -1}), 1U);      // which ends earlier
  EXPECT_EQ(count_with_triangle({0, 0, 0}, {-1, -1, 1}, {-1, -1, -1}), 0U);  // on the other side
  EXPECT_EQ(count_with_triangle({0, 0, 0}, {1, 1, 0}, {1, 2, 0}), 1U);       // in one plane
  EXPECT_EQ(count_with_triangle({0, 0, 0}, {-1, 0, 0}, {0, -1, 0}), 0U);     // in one plane, apart
  EXPECT_EQ(count_with_triangle({0, 0, 0}, {2, 0, 0}, {0, 0, 1}), 1U);       // along an edge
}

TEST(SelfIntersections, OfTrianglesThatShareAnEdge)
{
  EXPECT_EQ(count_with_triangle({0, 0, 0}, {4, 0, 0}, {1, -1, 0}), 0U);    // flat
  EXPECT_EQ(count_with_triangle({0, 0, 0}, {4, 0, 0}, {1, 1, 1e-9}), 0U);  // folded, not quite
  EXPECT_EQ(count_with_triangle({0, 0, 0}, {4, 0, 0}, {1, 1, 0}), 1U);     // folded
  EXPECT_EQ(count_with_triangle({0, 4, 0}, {4, 0, 0}, {0, 0, 0}), 1U);     // twice the same
}

TEST(SelfIntersections, OfASoundMeshAreNone)
{
  EXPECT_EQ(count_self_intersections(make_sphere(1, 5)), 0U);
  EXPECT_EQ(count_self_intersections(make_plane(0, 50)), 0U);
  TriangleMesh tilted = make_plane(0, 50);  // coplanar only within rounding
  const Eigen::Matrix3d turn = Eigen::AngleAxisd(1, Eigen::Vector3d(1, 2, 3).normalized()).toRotationMatrix();
  for (Eigen::Vector3d& p : tilted.vertices) p = turn * p;
  EXPECT_EQ(count_self_intersections(tilted), 0U);
}

TEST(SelfIntersections, AreTheSameForAnyNumberOfThreads)
{
  TriangleMesh mesh = make_sphere(1, 4);
  TriangleMesh other = mesh;
  for (Eigen::Vector3d& p : other.vertices) p.x() += 0.7;
  append(mesh, other);
  const std::size_t expected = count_self_intersections(mesh, 1);
  EXPECT_GT(expected, 100U);
  EXPECT_EQ(count_self_intersections(mesh, 4), expected);
}

TEST(SelfIntersections, OfNothing) { EXPECT_EQ(count_self_intersections({}), 0U); }

}  // namespace
}  // namespace pds
