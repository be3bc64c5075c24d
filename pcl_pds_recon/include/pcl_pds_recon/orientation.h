// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include <pcl_pds_recon/ordered_points.h>
#include <pcl_pds_recon/point_cloud_view.h>
#include <pcl_pds_recon/poisson_disk_sampling.h>
#include <pcl_pds_recon/triangle_complex.h>

namespace pds
{

/** \brief What decides the side that is outside; positions are those of the complex. */
struct OrientationCues
{
  std::vector<Eigen::Vector3d> normal;     ///< per vertex, from the input, or 0; empty if nothing is known
  std::vector<Eigen::Vector3d> viewpoint;  ///< per vertex: where the sensor stood, or NaN; empty if nothing is known
};

/** \brief What the cloud tells of its seeds, in the order of these; positions are in radii.
 * \param outward of the seeds, which counts if the cloud has neither normals nor viewpoints; may be empty */
[[nodiscard]] OrientationCues orientation_cues(const PointCloudView& cloud,
                                               const OrderedPoints& points,
                                               const PoissonDiskSampling& sampling,
                                               const std::vector<Eigen::Vector3d>& outward);

/** \brief The faces of the complex, each component turned to its outside.
 *
 * Closed components enclose a positive volume. Open ones follow, in this order, the input normals, the viewpoints,
 * the axis they face (a terrain faces up), the outside of the shape that they bend around. O(faces).
 */
[[nodiscard]] std::vector<Triangle> orient_faces(const TriangleComplex& complex, const OrientationCues& cues);

}  // namespace pds
