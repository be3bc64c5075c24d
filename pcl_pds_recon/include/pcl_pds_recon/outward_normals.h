// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include <pcl_pds_recon/seed_graph.h>

namespace pds
{

/** \brief The side of each seed that is outside: the mean over the seed's cell of the cloud's normals or, if it has
 * none, the seed's own normal, turned to where the sensors stood that saw the cell, or up in a cloud of which nothing
 * is known but that looks as if seen from above. Of length 1, or 0 where a cell has no normals or viewpoints, they
 * cancel out, or it cannot be seen from above. The sensor origin of a whole cloud does not count: it often is that of
 * the first of several scans.
 * \return empty if the cloud has none of these, or if they change sides where the surface does not bend, as normals do
 * that were estimated and never oriented */
[[nodiscard]] std::vector<Eigen::Vector3d> outward_normals(const PointCloudView& cloud,
                                                           const OrderedPoints& points,
                                                           const SeedGeometry& seeds,
                                                           const GeodesicVoronoi& voronoi,
                                                           const Parallel& parallel);

}  // namespace pds
