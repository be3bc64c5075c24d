// SPDX-License-Identifier: BSD-3-Clause
// PCL's NormalEstimationOMP and GreedyProjectionTriangulation, with the settings of PCL's tutorial but for lengths.
// Methods: gp3, all points, the parameter is the longest edge; voxel_gp3, after VoxelGrid, whose leaf it is.
#include <pcl/common/io.h>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/search/kdtree.h>
#include <pcl/surface/gp3.h>

#include <cmath>
#include <stdexcept>

#include "peer_run.h"

namespace
{

constexpr int normal_neighbors = 15;  // as many as pcl_pds_recon looks at
/// Longest edge over leaf: centroids of voxels that share a face are up to sqrt(6) leaves apart.
constexpr double voxel_edge = 2.5;

pcl::PolygonMesh triangulate(const peers::Cloud::Ptr& cloud, double longest_edge, unsigned threads)
{
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation(threads);
  estimation.setInputCloud(cloud);
  estimation.setKSearch(normal_neighbors);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  const pcl::PointCloud<pcl::PointNormal>::Ptr with_normals(new pcl::PointCloud<pcl::PointNormal>);
  pcl::concatenateFields(*cloud, normals, *with_normals);

  constexpr double degree = M_PI / 180.0;
  pcl::GreedyProjectionTriangulation<pcl::PointNormal> triangulation;
  triangulation.setSearchRadius(longest_edge);
  triangulation.setMu(2.5);
  triangulation.setMaximumNearestNeighbors(100);
  triangulation.setMaximumSurfaceAngle(45.0 * degree);
  triangulation.setMinimumAngle(10.0 * degree);
  triangulation.setMaximumAngle(120.0 * degree);
  triangulation.setNormalConsistency(false);
  triangulation.setInputCloud(with_normals);
  pcl::PolygonMesh mesh;
  triangulation.reconstruct(mesh);
  return mesh;
}

peers::Mesh reconstruct(const peers::Cloud::Ptr& cloud, const peers::Arguments& arguments, peers::Measurement& measured)
{
  pcl::PolygonMesh mesh;
  measured.start();
  if (arguments.method == "gp3") {
    mesh = triangulate(cloud, arguments.parameter, arguments.threads);
  } else {
    const auto leaf = static_cast<float>(arguments.parameter);
    pcl::VoxelGrid<pcl::PointXYZ> grid;
    grid.setInputCloud(cloud);
    grid.setLeafSize(leaf, leaf, leaf);
    const peers::Cloud::Ptr thinned(new peers::Cloud);
    grid.filter(*thinned);
    mesh = triangulate(thinned, voxel_edge * arguments.parameter, arguments.threads);
  }
  measured.stop();
  return peers::from_pcl(mesh);
}

}  // namespace

int main(int argc, char** argv) { return peers::run(argc, argv, reconstruct); }
