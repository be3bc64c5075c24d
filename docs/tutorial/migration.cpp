// SPDX-License-Identifier: BSD-3-Clause
// The same scan by other ways to a mesh that PCL has, and by Poisson-disk sampling. Usage: migration SCAN.ply
#include <pcl/features/normal_3d.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/io/ply_io.h>
#include <pcl/surface/gp3.h>
#include <pcl/surface/poisson.h>
#include <pcl/surface/poisson_disk_reconstruction.h>

#include <algorithm>
#include <iostream>
#include <utility>
#include <vector>

namespace
{

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
using CloudWithNormals = pcl::PointCloud<pcl::PointNormal>;

CloudWithNormals::Ptr estimate_normals(const Cloud::ConstPtr& cloud)
{
  CloudWithNormals::Ptr with_normals(new CloudWithNormals);
  pcl::copyPointCloud(*cloud, *with_normals);
  pcl::NormalEstimation<pcl::PointXYZ, pcl::PointNormal> estimation;
  estimation.setInputCloud(cloud);
  estimation.setKSearch(15);
  estimation.compute(*with_normals);
  for (std::size_t i = 0; i < cloud->size(); ++i) (*with_normals)[i].getVector3fMap() = (*cloud)[i].getVector3fMap();
  return with_normals;
}

pcl::PolygonMesh with_gp3(const Cloud::ConstPtr& cloud)
{
  // [gp3]
  CloudWithNormals::Ptr points = estimate_normals(cloud);
  pcl::search::KdTree<pcl::PointNormal>::Ptr tree(new pcl::search::KdTree<pcl::PointNormal>);
  pcl::GreedyProjectionTriangulation<pcl::PointNormal> gp3;
  gp3.setInputCloud(points);
  gp3.setSearchMethod(tree);
  gp3.setSearchRadius(0.05);
  gp3.setMu(2.5);
  gp3.setMaximumNearestNeighbors(100);
  pcl::PolygonMesh mesh;
  gp3.reconstruct(mesh);
  // [gp3]
  return mesh;
}

pcl::PolygonMesh instead_of_gp3(const Cloud::ConstPtr& points)
{
  // [instead_of_gp3]
  pcl::PoissonDiskReconstruction<pcl::PointXYZ> reconstruction;
  reconstruction.setInputCloud(points);  // no normals
  reconstruction.setRadiusFactor(2);     // finer than the default, 3; the limit is 1.5
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  // [instead_of_gp3]
  return mesh;
}

pcl::PolygonMesh with_poisson(const Cloud::ConstPtr& cloud)
{
  // [poisson]
  CloudWithNormals::Ptr points = estimate_normals(cloud);  // and turn all of them outward
  pcl::Poisson<pcl::PointNormal> poisson;
  poisson.setInputCloud(points);
  poisson.setDepth(6);
  pcl::PolygonMesh mesh;
  poisson.reconstruct(mesh);
  // [poisson]
  return mesh;
}

pcl::PolygonMesh instead_of_poisson(const Cloud::ConstPtr& points)
{
  // [instead_of_poisson]
  pcl::PoissonDiskReconstruction<pcl::PointXYZ> reconstruction;
  reconstruction.setInputCloud(points);
  reconstruction.setPlacement(pds::Placement::quadric);  // vertices off the points, as those of Poisson are
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  // [instead_of_poisson]
  return mesh;
}

pcl::PolygonMesh instead_of_ball_pivoting(const Cloud::ConstPtr& points)
{
  // [instead_of_ball_pivoting]
  pcl::PoissonDiskReconstruction<pcl::PointXYZ> reconstruction;
  reconstruction.setInputCloud(points);
  reconstruction.setRadius(0.05);  // one radius: gaps are bridged by neighbours, not by larger balls
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  // [instead_of_ball_pivoting]
  return mesh;
}

pcl::PolygonMesh with_voxel_grid(const Cloud::ConstPtr& cloud)
{
  // [voxel_grid]
  Cloud::Ptr thinned(new Cloud);
  pcl::VoxelGrid<pcl::PointXYZ> grid;
  grid.setInputCloud(cloud);
  grid.setLeafSize(0.04F, 0.04F, 0.04F);
  grid.filter(*thinned);
  CloudWithNormals::Ptr points = estimate_normals(thinned);
  pcl::GreedyProjectionTriangulation<pcl::PointNormal> gp3;
  gp3.setInputCloud(points);
  gp3.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointNormal>>());
  gp3.setSearchRadius(0.15);
  gp3.setMu(2.5);
  gp3.setMaximumNearestNeighbors(100);
  pcl::PolygonMesh mesh;
  gp3.reconstruct(mesh);
  // [voxel_grid]
  return mesh;
}

pcl::PolygonMesh instead_of_voxel_grid(const Cloud::ConstPtr& points)
{
  // [instead_of_voxel_grid]
  pcl::PoissonDiskReconstruction<pcl::PointXYZ> reconstruction;
  reconstruction.setInputCloud(points);  // all of them: what is left out still shapes the cells
  reconstruction.setRadius(0.05);        // vertices 0.05 apart, measured along the surface
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  // [instead_of_voxel_grid]
  return mesh;
}

/** \brief Prints the size of a mesh and what is wrong with it. \return the number of edges of more than two faces */
std::size_t print(const char* name, const pcl::PolygonMesh& mesh)
{
  std::vector<std::pair<pcl::index_t, pcl::index_t>> edges;
  for (const pcl::Vertices& polygon : mesh.polygons) {
    for (std::size_t i = 0; i < polygon.vertices.size(); ++i) {
      edges.emplace_back(std::minmax(polygon.vertices[i], polygon.vertices[(i + 1) % polygon.vertices.size()]));
    }
  }
  std::sort(edges.begin(), edges.end());
  std::size_t open = 0;
  std::size_t nonmanifold = 0;
  for (auto edge = edges.begin(); edge != edges.end();) {
    const auto next = std::upper_bound(edge, edges.end(), *edge);
    open += next - edge == 1;
    nonmanifold += next - edge > 2;
    edge = next;
  }
  std::cout << name << ": " << mesh.cloud.width * mesh.cloud.height << " vertices, " << mesh.polygons.size()
            << " faces, boundary edges " << open << ", non-manifold edges " << nonmanifold << '\n';
  return nonmanifold;
}

}  // namespace

int main(int argc, char** argv)
{
  Cloud::Ptr cloud(new Cloud);
  if (argc != 2 || pcl::io::loadPLYFile(argv[1], *cloud) != 0) {
    std::cerr << "usage: migration SCAN.ply\n";
    return 2;
  }
  std::size_t faults = 0;
  print("GP3", with_gp3(cloud));
  faults += print("  instead", instead_of_gp3(cloud));
  print("Poisson", with_poisson(cloud));
  faults += print("  instead", instead_of_poisson(cloud));
  faults += print("instead of ball pivoting", instead_of_ball_pivoting(cloud));
  print("voxel grid and GP3", with_voxel_grid(cloud));
  faults += print("  instead", instead_of_voxel_grid(cloud));
  return faults == 0 ? 0 : 1;
}
