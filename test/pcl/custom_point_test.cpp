// SPDX-License-Identifier: BSD-3-Clause
// A point type of the user's own, and the program of PCL's tutorial "Fast triangulation of unordered point clouds" with
// no more than the class and its parameters changed. Both need templates that no library holds for them.
#define PCL_NO_PRECOMPILE
#include <pcl/common/io.h>
#include <pcl/features/normal_3d.h>
#include <pcl/search/kdtree.h>

#include "test_clouds.h"

/** \brief A LiDAR return: fields of several sizes, with padding between them. */
struct LidarReturn
{
  PCL_ADD_POINT4D;
  std::uint8_t return_number;
  double gps_time;
  std::uint16_t intensity;
  PCL_MAKE_ALIGNED_OPERATOR_NEW
} EIGEN_ALIGN16;

POINT_CLOUD_REGISTER_POINT_STRUCT(LidarReturn,
                                  (float, x, x)(float, y, y)(float, z, z)(std::uint8_t, return_number, return_number)(
                                      double, gps_time, gps_time)(std::uint16_t, intensity, intensity))

namespace pcl_test
{
namespace
{

TEST(PoissonDiskReconstructionCustomPoint, WorksAndKeepsAllFields)
{
  const auto cloud = makeSphere<LidarReturn>();
  for (std::size_t i = 0; i < cloud->size(); ++i) {
    (*cloud)[i].return_number = static_cast<std::uint8_t>(i % 5);
    (*cloud)[i].gps_time = 1e9 + 1e-6 * static_cast<double>(i);
    (*cloud)[i].intensity = static_cast<std::uint16_t>(i);
  }
  pcl::PoissonDiskReconstruction<LidarReturn> reconstruction;
  reconstruction.setInputCloud(cloud);
  reconstruction.setSearchMethod(pcl::search::Search<LidarReturn>::Ptr(new pcl::search::KdTree<LidarReturn>));
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  expectClosedSurface(mesh.polygons);

  pcl::PointCloud<LidarReturn> vertices;
  pcl::fromPCLPointCloud2(mesh.cloud, vertices);
  ASSERT_EQ(vertices.size(), reconstruction.getSeedIndices().size());
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const LidarReturn& seed = cloud->at(static_cast<std::size_t>(reconstruction.getSeedIndices()[i]));
    EXPECT_EQ(vertices[i].getVector3fMap(), seed.getVector3fMap());
    EXPECT_EQ(vertices[i].return_number, seed.return_number);
    EXPECT_EQ(vertices[i].gps_time, seed.gps_time);
    EXPECT_EQ(vertices[i].intensity, seed.intensity);
  }
}

TEST(PoissonDiskReconstructionTutorial, GreedyProjectionProgramRuns)
{
  // Load input file into a PointCloud<T> with an appropriate type
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  pcl::PCLPointCloud2 cloud_blob;
  pcl::toPCLPointCloud2(*makeSphere<pcl::PointXYZ>(), cloud_blob);  // the tutorial's bunny has 397 points: not dense
  pcl::fromPCLPointCloud2(cloud_blob, *cloud);

  // Normal estimation*
  pcl::NormalEstimation<pcl::PointXYZ, pcl::Normal> n;
  pcl::PointCloud<pcl::Normal>::Ptr normals(new pcl::PointCloud<pcl::Normal>);
  pcl::search::KdTree<pcl::PointXYZ>::Ptr tree(new pcl::search::KdTree<pcl::PointXYZ>);
  tree->setInputCloud(cloud);
  n.setInputCloud(cloud);
  n.setSearchMethod(tree);
  n.setKSearch(20);
  n.compute(*normals);

  // Concatenate the XYZ and normal fields*
  pcl::PointCloud<pcl::PointNormal>::Ptr cloud_with_normals(new pcl::PointCloud<pcl::PointNormal>);
  pcl::concatenateFields(*cloud, *normals, *cloud_with_normals);

  // Create search tree*
  pcl::search::KdTree<pcl::PointNormal>::Ptr tree2(new pcl::search::KdTree<pcl::PointNormal>);
  tree2->setInputCloud(cloud_with_normals);

  // Initialize objects
  pcl::PoissonDiskReconstruction<pcl::PointNormal> gp3;
  pcl::PolygonMesh triangles;

  // Set typical values for the parameters
  gp3.setRadiusFactor(3.0);
  gp3.setKSearch(15);

  // Get result
  gp3.setInputCloud(cloud_with_normals);
  gp3.setSearchMethod(tree2);
  gp3.reconstruct(triangles);

  EXPECT_EQ(gp3.getStatus(), pcl::PoissonDiskStatus::success);
  expectClosedSurface(triangles.polygons);
  EXPECT_EQ(triangles.cloud.width * triangles.cloud.height, gp3.getSeedIndices().size());
}

}  // namespace
}  // namespace pcl_test
