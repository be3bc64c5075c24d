// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/ordered_points.h>
#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/point_cloud_view.h>
#include <pcl_pds_recon/poisson_disk_sampling.h>
#include <pcl_pds_recon/triangle_complex.h>
#include <Eigen/Core>
#include <vector>

namespace pds
{

/** \brief The distance from the mesh, in input units, that a share of the points does not exceed.
 *
 * A point is measured against the faces at its seed and at the seeds next to it: what else were nearer would be another
 * sheet. Infinite where there are no such faces. Thinned and coincident points count. O(points).
 * \param position of the seeds, in radii
 * \param share 0 ... 1 */
[[nodiscard]] double distance_of_share(const PointCloudView& cloud,
                                       const OrderedPoints& points,
                                       const PoissonDiskSampling& sampling,
                                       const std::vector<Eigen::Vector3d>& position,
                                       const std::vector<Triangle>& triangles,
                                       double share,
                                       const Parallel& parallel);

}  // namespace pds
