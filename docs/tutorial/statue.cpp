// SPDX-License-Identifier: BSD-3-Clause
// Usage: statue SCAN.ply... MESH.ply
#include <pcl/io/ply_io.h>
#include <pcl/surface/poisson_disk_reconstruction.h>

#include <iostream>

int main(int argc, char** argv)
{
  if (argc < 3) {
    std::cerr << "usage: statue SCAN.ply... MESH.ply\n";
    return 2;
  }

  // The scans must lie in one frame: they are registered. Then merging is putting all points together.
  pcl::PointCloud<pcl::PointXYZ>::Ptr cloud(new pcl::PointCloud<pcl::PointXYZ>);
  for (int i = 1; i < argc - 1; ++i) {
    pcl::PointCloud<pcl::PointXYZ> scan;
    if (pcl::io::loadPLYFile(argv[i], scan) != 0) return 1;
    *cloud += scan;
  }

  // [reconstruct]
  pcl::PoissonDiskReconstruction<pcl::PointXYZ> reconstruction;
  reconstruction.setInputCloud(cloud);
  reconstruction.setRadiusFactor(3);                     // the default
  reconstruction.setPlacement(pds::Placement::quadric);  // vertices in the middle of the noise
  pcl::PolygonMesh mesh;
  reconstruction.reconstruct(mesh);
  if (reconstruction.getStatus() != pcl::PoissonDiskStatus::success) {
    std::cerr << reconstruction.getStatusMessage() << '\n';
    return 1;
  }
  // [reconstruct]

  const pds::Report& report = reconstruction.getReport();
  std::cout << report.input_points << " points, " << report.vertices << " vertices, " << report.faces << " faces\n"
            << (report.closed ? "closed" : "open") << ", components: " << report.components
            << ", boundary loops: " << report.boundary_loops << ", Euler characteristic: " << report.euler << '\n';
  return pcl::io::savePLYFileBinary(argv[argc - 1], mesh) == 0 ? 0 : 1;
}
