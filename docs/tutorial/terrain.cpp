// SPDX-License-Identifier: BSD-3-Clause
// Usage: terrain POINTS.xyz MESH.obj
#include <pcl_pds_recon/reconstruction.h>

#include <fstream>
#include <iomanip>
#include <iostream>
#include <vector>

int main(int argc, char** argv)
{
  if (argc != 3) {
    std::cerr << "usage: terrain POINTS.xyz MESH.obj\n";
    return 2;
  }

  // Coordinates of a map have more digits than a float, and so than a point type of PCL. The core reads doubles.
  std::vector<double> xyz;
  std::ifstream points(argv[1]);
  for (double number = 0; points >> number;) xyz.push_back(number);
  if (xyz.empty()) {
    std::cerr << argv[1] << ": no points\n";
    return 1;
  }

  pds::PointCloudView cloud;
  cloud.size = xyz.size() / 3;
  cloud.positions = pds::Vector3View(xyz.data(), 3 * sizeof(double));
  // An open surface without normals faces the sensor, here one that flew 1000 m above the first point.
  cloud.sensor_origin = cloud.positions[0] + Eigen::Vector3d(0, 0, 1000);

  pds::Options options;
  options.radius = 3.0;      // metres
  options.hole_size = 15.0;  // radii: houses, whose ground nobody saw, stay open
  try {
    const pds::Reconstruction mesh = pds::reconstruct(cloud, options);
    std::ofstream obj(argv[2]);
    obj << std::fixed << std::setprecision(3);
    for (std::size_t i = 0; i < mesh.report.vertices; ++i) {
      const Eigen::Vector3d p = cloud.positions[mesh.seeds[i]];  // a point of the input, to the last bit
      obj << "v " << p.x() << ' ' << p.y() << ' ' << p.z() << '\n';
    }
    for (const auto& face : mesh.triangles) {
      obj << "f " << face[0] + 1 << ' ' << face[1] + 1 << ' ' << face[2] + 1 << '\n';
    }
    std::cout << mesh.report.vertices << " vertices, " << mesh.report.faces << " faces\n";
    return obj.good() ? 0 : 1;
  } catch (const pds::InvalidInput& error) {
    std::cerr << argv[1] << ": " << error.what() << '\n';
    return 1;
  }
}
