// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include <pcl_pds_recon/triangle_complex.h>

namespace pds
{

/** \brief What decides the side that is outside; positions are those of the complex. */
struct OrientationCues
{
  std::vector<Eigen::Vector3d> normal;           ///< per vertex, from the input; empty if it has none
  std::optional<Eigen::Vector3d> sensor_origin;  ///< where the scanner stood
};

/** \brief The faces of the complex, each component turned to its outside.
 *
 * Closed components enclose a positive volume. Open ones follow, in this order, the input normals, the sensor origin,
 * the axis they face (a terrain faces up), the outside of the shape that they bend around. O(faces).
 */
[[nodiscard]] std::vector<Triangle> orient_faces(const TriangleComplex& complex, const OrientationCues& cues);

}  // namespace pds
