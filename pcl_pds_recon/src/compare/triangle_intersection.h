// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>

namespace pds
{

using TriangleCorners = std::array<Eigen::Vector3d, 3>;

/** \brief Whether two triangles meet in more than a corner or an edge that they share. Exact. Corners are the same if
 * their coordinates are.
 * \param first, second with an area
 */
[[nodiscard]] bool triangles_intersect(const TriangleCorners& first, const TriangleCorners& second);

}  // namespace pds
