// SPDX-License-Identifier: BSD-3-Clause
#include "html/deviation.h"

#include <pcl_pds_recon/deviation.h>

#include <exception>

namespace pds
{

void pcl_pds_recon_measure_deviation(const TriangleMesh& mesh,
                                     const std::vector<Eigen::Vector3d>& cloud,
                                     unsigned threads,
                                     std::vector<double>& deviation,
                                     std::string& complaint)
{
  try {
    deviation = signed_distances(mesh, cloud, threads);
  } catch (const std::exception& error) {
    complaint = error.what();
  }
}

}  // namespace pds
