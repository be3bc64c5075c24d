// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include <pcl_pds_recon/seed_graph.h>

namespace pds
{

/** \brief The side of each seed that is outside by the normals of the cloud: their mean over the seed's cell, of length
 * 1, or 0 where a cell has none or they cancel out.
 * \return empty if the cloud has no normals, or if they change sides where the surface does not bend, as normals do
 * that were estimated and never oriented */
[[nodiscard]] std::vector<Eigen::Vector3d> outward_normals(const PointCloudView& cloud,
                                                           const OrderedPoints& points,
                                                           const SeedGeometry& seeds,
                                                           const GeodesicVoronoi& voronoi,
                                                           const Parallel& parallel);

}  // namespace pds
