// SPDX-License-Identifier: BSD-3-Clause
#include "html/deviation.h"

#include "io/plugin.h"

namespace pds
{

std::vector<double> measure_cloud_deviation([[maybe_unused]] const TriangleMesh& mesh,
                                            [[maybe_unused]] const std::vector<Eigen::Vector3d>& cloud,
                                            [[maybe_unused]] unsigned threads)
{
#ifdef PCL_PDS_RECON_WITH_DEVIATION
  std::vector<double> deviation;
  std::string complaint;
  void* function = load_plugin_function("pcl_pds_recon_deviation", "pcl_pds_recon_measure_deviation");
  reinterpret_cast<decltype(&pcl_pds_recon_measure_deviation)>(function)(mesh, cloud, threads, deviation, complaint);
  if (!complaint.empty()) {
    throw PluginError(complaint);
  }
  return deviation;
#else
  throw PluginError("this build is without Embree, which measures it");
#endif
}

}  // namespace pds
