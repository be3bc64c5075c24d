// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/triangle_mesh.h>

#include <vector>

namespace pds
{

/** \brief Length of each edge, once whether one or two faces have it. O(n log n). */
[[nodiscard]] std::vector<double> edge_lengths(const TriangleMesh& mesh);

/** \brief The smallest angle of each face in degrees, 0 ... 60; 0 of a face without area. */
[[nodiscard]] std::vector<double> smallest_angles(const TriangleMesh& mesh);

}  // namespace pds
