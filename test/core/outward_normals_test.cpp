// SPDX-License-Identifier: BSD-3-Clause
#include "core_testing.h"

/** \brief Normals of the cloud, or its viewpoints, keep outsides and insides apart. */
namespace pds_test
{
namespace
{

pds::PointCloudView view_with(const Points& points, const Points& normals)
{
  pds::PointCloudView cloud = view_of(points);
  cloud.normals = pds::Vector3View(normals.front().data(), sizeof(Eigen::Vector3d));
  return cloud;
}

pds::PointCloudView view_seen_from(const Points& points, const Points& viewpoints)
{
  pds::PointCloudView cloud = view_of(points);
  cloud.viewpoints = pds::Vector3View(viewpoints.front().data(), sizeof(Eigen::Vector3d));
  return cloud;
}

/** \brief Expects one part of a plane to face up, that of x > 0, and the other down. */
void expect_two_sides(const pds::Reconstruction& mesh, const Points& points)
{
  expect_sound(mesh, points);
  EXPECT_EQ(mesh.report.components, 2U);
  const Points at = vertex_positions(mesh, points);
  for (const auto& t : mesh.triangles) {
    const Eigen::Vector3d area = (at[t[1]] - at[t[0]]).cross(at[t[2]] - at[t[0]]);
    const double x = (at[t[0]].x() + at[t[1]].x() + at[t[2]].x()) / 3;
    if (std::abs(x) > mesh.report.radius) {
      EXPECT_GT(area.z() * x, 0);
    }
  }
}

/** \brief Two half planes that meet at the y axis: one faces up, the other, which continues it, down. */
TEST(OutwardNormals, DoNotLetAnOutsideContinueAsAnInside)
{
  const Points points = plane(small_cloud);
  Points normals;
  for (const Eigen::Vector3d& p : points) normals.emplace_back(0, 0, p.x() > 0 ? 1 : -1);
  expect_two_sides(pds::reconstruct(view_with(points, normals), {}), points);
}

/** \brief Likewise: one half was seen from above, the other from below. */
TEST(OutwardNormals, FollowTheViewpointsOfACloudThatHasNone)
{
  const Points points = plane(small_cloud);
  Points viewpoints;
  for (const Eigen::Vector3d& p : points) viewpoints.emplace_back(0.3, 0.1, p.x() > 0 ? 3 : -2);
  expect_two_sides(pds::reconstruct(view_seen_from(points, viewpoints), {}), points);
}

/** \brief Six sensors around a body. */
TEST(OutwardNormals, OfViewpointsDoNotChangeAMeshThatAgreesWithThem)
{
  for (const Points& points : {sphere(small_cloud), cube(small_cloud)}) {
    Points viewpoints;
    for (const Eigen::Vector3d& p : points) {
      Eigen::Index axis = 0;
      p.cwiseAbs().maxCoeff(&axis);
      viewpoints.emplace_back(5 * std::copysign(1, p[axis]) * Eigen::Vector3d::Unit(axis));
    }
    EXPECT_EQ(pds::reconstruct(view_seen_from(points, viewpoints), {}).triangles, reconstruct(points).triangles);
  }
}

TEST(OutwardNormals, ThatWereNeverOrientedAreNotBelieved)
{
  const Points points = sphere(small_cloud);
  Random random(4);
  Points normals;
  for (const Eigen::Vector3d& p : points) normals.push_back(random.below(2) == 0 ? p : Eigen::Vector3d(-p));
  expect_closed(pds::reconstruct(view_with(points, normals), {}), points, 0);
}

TEST(OutwardNormals, MayBeMissingInPlaces)
{
  const Points points = sphere(small_cloud);
  Points normals;
  for (const Eigen::Vector3d& p : points) {
    normals.push_back(p);
    if (p.z() > 0) normals.back().setZero();
    if (p.z() > 0.5) normals.back().setConstant(std::nan(""));
  }
  expect_closed(pds::reconstruct(view_with(points, normals), {}), points, 0);
}

TEST(OutwardNormals, DoNotChangeAMeshThatAgreesWithThem)
{
  for (const Points& points : {sphere(small_cloud), cube(small_cloud)}) {
    Points normals;
    for (const Eigen::Vector3d& p : points) normals.push_back(p.normalized());
    EXPECT_EQ(pds::reconstruct(view_with(points, normals), {}).triangles, reconstruct(points).triangles);
  }
}

}  // namespace
}  // namespace pds_test
