// SPDX-License-Identifier: BSD-3-Clause
#include "core_testing.h"

/** \brief Normals of the cloud keep outsides and insides apart. */
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

/** \brief Two half planes that meet at the y axis: one faces up, the other, which continues it, down. */
TEST(OutwardNormals, DoNotLetAnOutsideContinueAsAnInside)
{
  const Points points = plane(small_cloud);
  Points normals;
  for (const Eigen::Vector3d& p : points) normals.emplace_back(0, 0, p.x() > 0 ? 1 : -1);
  const pds::Reconstruction mesh = pds::reconstruct(view_with(points, normals), {});
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
