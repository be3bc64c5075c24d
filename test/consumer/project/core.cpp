// SPDX-License-Identifier: BSD-3-Clause
// Meshes a tilted plane with the core library alone; fails unless the mesh is one open sheet.
#include <pcl_pds_recon/reconstruction.h>
#include <pcl_pds_recon/version.h>

#include <array>
#include <cstdio>
#include <vector>

int main()
{
  constexpr int side = 60;
  std::vector<std::array<float, 3>> points;
  for (int i = 0; i < side * side; ++i) {
    const auto x = static_cast<float>(i % side + 0.3 * (i / side % 2));
    const auto y = static_cast<float>(i / side);
    points.push_back({x, y, 0.25F * x});
  }
  pds::PointCloudView cloud;
  cloud.size = points.size();
  cloud.positions = pds::Vector3View(points.front().data(), sizeof points.front());
  const pds::Reconstruction result = pds::reconstruct(cloud, pds::Options());
  std::printf("%s: %zu vertices, %zu faces\n", PCL_PDS_RECON_VERSION, result.report.vertices, result.report.faces);
  return result.report.components == 1 && result.report.boundary_loops == 1 ? 0 : 1;
}
