// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/io/ply_io.h>
#include <pcl/io/vtk_io.h>
#include <pcl/surface/poisson_disk_reconstruction.h>

int main()
{
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  pcl::io::loadPLYFile("scan.ply", *cloud);
  pcl::PoissonDiskReconstruction<pcl::PointXYZ> reconstruction;
  reconstruction.setInputCloud(cloud);
  reconstruction.setRadiusFactor(3.0);          // vertices three sampling intervals apart
  reconstruction.setAdaptiveCoefficient(0.25);  // closer where the surface bends
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  pcl::io::saveVTKFile("mesh.vtk", mesh);
}
