// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <pcl/features/normal_3d.h>
#include <pcl/kdtree/kdtree_flann.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include "core_testing.h"

/** \brief The core's neighbours and curvature against those of PCL, which the project promises to equal. */
namespace pds_test
{
namespace
{

pcl::PointCloud<pcl::PointXYZ>::Ptr to_pcl(const pds::OrderedPoints& points)
{
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (const Eigen::Vector3f& p : points.position) cloud->push_back({p.x(), p.y(), p.z()});
  return cloud;
}

TEST(AgainstPcl, NeighborDistancesEqualThoseOfKdTreeFlann)
{
  for (const Points& input : {torus(20000), cube(10000), swiss_roll(10000)})
    for (const int k : {5, 15, 30}) {
      const Stages stages(input, k);
      const auto cloud = to_pcl(stages.points);
      pcl::KdTreeFLANN<pcl::PointXYZ> tree;
      tree.setInputCloud(cloud);
      std::vector<int> index;
      std::vector<float> squared_distance;
      for (std::size_t i = 0; i < stages.points.size(); ++i) {
        ASSERT_EQ(tree.nearestKSearch((*cloud)[i], k + 1, index, squared_distance), k + 1);
        std::size_t place = 1;  // the point itself comes first
        for (const std::uint32_t j : stages.graph.nearest(i)) {
          const float own = (stages.points.position[i] - stages.points.position[j]).squaredNorm();
          ASSERT_NEAR(own, squared_distance[place], 1e-5F * own) << "neighbour " << place << " of point " << i;
          ++place;
        }
      }
    }
}

TEST(AgainstPcl, CurvatureIsTheRootOfComputePointNormals)
{
  for (const Points& input : {torus(20000), cube(10000), saddle(10000)}) {
    const Stages stages(input);
    const pds::SurfaceEstimate surface = pds::estimate_surface(stages.points, stages.graph, stages.parallel);
    const auto cloud = to_pcl(stages.points);
    double largest = 0;
    for (std::size_t i = 0; i < stages.points.size(); ++i) {
      pcl::Indices indices{static_cast<pcl::index_t>(i)};
      for (const std::uint32_t j : stages.graph.nearest(i)) indices.push_back(static_cast<pcl::index_t>(j));
      Eigen::Vector4f plane;
      float variation = 0;
      ASSERT_TRUE(pcl::computePointNormal(*cloud, indices, plane, variation));
      // Both find the smallest of three eigenvalues; PCL does so in single precision.
      constexpr float rounding = 2e-5F;
      const float own = surface.curvature[i] * surface.curvature[i];
      ASSERT_NEAR(own, variation, rounding + 1e-3F * variation) << "point " << i;
      largest = std::max(largest, static_cast<double>(own));
      // Where one direction is clearly the thinnest, there is only one normal.
      if (variation < 0.1F) {
        ASSERT_GT(std::abs(surface.normal[i].dot(plane.head<3>())), 0.999F) << "point " << i;
      }
    }
    EXPECT_GT(largest, 1e-4) << "a comparison of rounding errors says nothing";
  }
}

}  // namespace
}  // namespace pds_test
