// SPDX-License-Identifier: BSD-3-Clause
// pcl_pds_recon through its PCL class. Methods: factor and radius, which say what the parameter is.
#include <pcl/surface/poisson_disk_reconstruction.h>

#include <stdexcept>

#include "peer_run.h"

namespace
{

peers::Mesh reconstruct(const peers::Cloud::Ptr& cloud, const peers::Arguments& arguments, peers::Measurement& measured)
{
  pcl::PoissonDiskReconstruction<pcl::PointXYZ> reconstruction;
  reconstruction.setInputCloud(cloud);
  reconstruction.setNumberOfThreads(arguments.threads);
  if (arguments.method == "factor") {
    reconstruction.setRadiusFactor(arguments.parameter);
  } else {
    reconstruction.setRadius(arguments.parameter);
  }
  pcl::PolygonMesh mesh;
  measured.start();
  reconstruction.reconstruct(mesh);
  measured.stop();
  if (!reconstruction.getStatusMessage().empty()) throw std::runtime_error(reconstruction.getStatusMessage());
  peers::Mesh result = peers::from_pcl(mesh);
  result.radius = reconstruction.getReport().radius;
  return result;
}

}  // namespace

int main(int argc, char** argv) { return peers::run(argc, argv, reconstruct); }
