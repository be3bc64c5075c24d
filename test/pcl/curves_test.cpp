// SPDX-License-Identifier: BSD-3-Clause
// Curves come out as polygons of two vertices.
#include <pcl/conversions.h>

#include "test_clouds.h"

namespace pcl_test
{
namespace
{

using pcl::PointXYZ;
using Reconstruction = pcl::PoissonDiskReconstruction<PointXYZ>;

pcl::PointCloud<PointXYZ>::Ptr makeRing(float radius)
{
  constexpr int count = 3000;
  pcl::PointCloud<PointXYZ>::Ptr cloud(new pcl::PointCloud<PointXYZ>);
  for (int i = 0; i < count; ++i) {
    const float angle = 6.2831853F * static_cast<float>(i) / count;
    cloud->push_back(PointXYZ(radius * std::cos(angle), radius * std::sin(angle), 0));
  }
  return cloud;
}

TEST(Curves, AreClosedChainsOfPolygonsOfTwo)
{
  Reconstruction reconstruction;
  reconstruction.setInputCloud(makeRing(1));
  reconstruction.setDimension(Reconstruction::Dimension::curve);
  EXPECT_EQ(reconstruction.getDimension(), Reconstruction::Dimension::curve);
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  ASSERT_EQ(reconstruction.getStatus(), pcl::PoissonDiskStatus::success);
  ASSERT_GT(mesh.polygons.size(), 100U);
  EXPECT_EQ(mesh.cloud.width * mesh.cloud.height, mesh.polygons.size());
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    ASSERT_EQ(mesh.polygons[i].vertices.size(), 2U);
    const pcl::Vertices& next = mesh.polygons[(i + 1) % mesh.polygons.size()];
    EXPECT_EQ(mesh.polygons[i].vertices[1], next.vertices[0]);
  }
  EXPECT_EQ(reconstruction.getReport().closed_curves, 1U);

  std::vector<pcl::Vertices> polygons;
  reconstruction.reconstruct(polygons);
  ASSERT_EQ(polygons.size(), mesh.polygons.size());
  EXPECT_EQ(polygons[3].vertices[0], reconstruction.getSeedIndices()[3]);
}

TEST(Curves, FollowTheTrianglesOfSurfaces)
{
  const auto cloud = makeSphere<PointXYZ>();
  *cloud += *makeRing(4);
  Reconstruction reconstruction;
  reconstruction.setInputCloud(cloud);
  reconstruction.setDimension(Reconstruction::Dimension::automatic);
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  ASSERT_EQ(reconstruction.getStatus(), pcl::PoissonDiskStatus::success);
  const pds::Report& report = reconstruction.getReport();
  EXPECT_EQ(report.curves, 1U);
  ASSERT_EQ(mesh.polygons.size(), report.faces + report.segments);
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i)
    EXPECT_EQ(mesh.polygons[i].vertices.size(), i < report.faces ? 3U : 2U);
}

TEST(Curves, RefuseWhatIsAboutTriangles)
{
  Reconstruction reconstruction;
  reconstruction.setInputCloud(makeRing(1));
  reconstruction.setDimension(Reconstruction::Dimension::curve);
  reconstruction.setRelaxationSteps(3);
  std::vector<pcl::Vertices> polygons;
  reconstruction.reconstruct(polygons);
  EXPECT_EQ(reconstruction.getStatus(), pcl::PoissonDiskStatus::invalid_option);
  EXPECT_EQ(reconstruction.getStatusMessage().rfind("relax", 0), 0U);
  EXPECT_TRUE(polygons.empty());
}

}  // namespace
}  // namespace pcl_test
