// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/triangle_mesh.h>

#include <string>
#include <vector>

namespace pds
{

/** \brief Signed distance of each point of a cloud from the mesh made of it, measured by the plugin that links Embree:
 * positive outside, NaN if the point is not finite.
 * \throws PluginError if the plugin is not there or cannot measure; what() says why */
[[nodiscard]] std::vector<double> measure_cloud_deviation(const TriangleMesh& mesh,
                                                          const std::vector<Eigen::Vector3d>& cloud,
                                                          unsigned threads);

/** \brief The plugin's function. What goes wrong is left in \a complaint, since no exception may leave a plugin. */
extern "C" void pcl_pds_recon_measure_deviation(const TriangleMesh& mesh,
                                                const std::vector<Eigen::Vector3d>& cloud,
                                                unsigned threads,
                                                std::vector<double>& deviation,
                                                std::string& complaint);

}  // namespace pds
