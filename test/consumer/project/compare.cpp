// SPDX-License-Identifier: BSD-3-Clause
// Measures how far an octahedron is from one that is shifted, with the comparison library alone; fails unless the
// distance is that of two planes.
#include <pcl_pds_recon/deviation.h>

#include <cmath>
#include <cstdio>

int main()
{
  pds::TriangleMesh octahedron;
  octahedron.vertices = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  octahedron.faces = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {1, 0, 5}, {3, 1, 5}, {4, 3, 5}, {0, 4, 5}};
  pds::TriangleMesh larger = octahedron;
  for (Eigen::Vector3d& vertex : larger.vertices) {
    vertex *= 1.1;
  }
  const double wanted = 0.1 / std::sqrt(3.0);  // between faces whose planes are x + y + z = 1 and 1.1
  const pds::Deviation deviation = pds::measure_deviation(octahedron, larger);
  std::printf("mean distance %g, wanted %g\n", deviation.mesh_to_reference.mean, wanted);
  return std::abs(deviation.mesh_to_reference.mean - wanted) < 1e-6 ? 0 : 1;
}
