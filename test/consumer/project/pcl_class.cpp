// SPDX-License-Identifier: BSD-3-Clause
// Meshes a sphere with the installed library; fails unless the mesh is a closed surface of genus 0.
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>
#include <pcl/surface/poisson_disk_reconstruction.h>

#include <cmath>
#include <cstdio>

int main()
{
  // A Fibonacci lattice: evenly spread points of the unit sphere.
  constexpr int size = 10000;
  const double golden_angle = M_PI * (3.0 - std::sqrt(5.0));
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (int i = 0; i < size; ++i) {
    const double z = 1.0 - (2.0 * i + 1.0) / size;
    const double ring = std::sqrt(1.0 - z * z);
    cloud->push_back(pcl::PointXYZ(static_cast<float>(ring * std::cos(golden_angle * i)),
                                   static_cast<float>(ring * std::sin(golden_angle * i)), static_cast<float>(z)));
  }

  pcl::PoissonDiskReconstruction<pcl::PointXYZ> reconstruction;
  reconstruction.setInputCloud(cloud);
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);

  const std::size_t vertices = mesh.cloud.width * mesh.cloud.height;
  const std::size_t faces = mesh.polygons.size();
  std::printf("%zu vertices, %zu faces\n", vertices, faces);
  const bool is_sphere = faces > 0 && faces == 2 * vertices - 4 && reconstruction.getReport().closed;
  return is_sphere ? 0 : 1;
}
