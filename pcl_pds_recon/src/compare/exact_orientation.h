// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>

namespace pds
{

/** \brief Sign (-1, 0, 1) of the volume of the tetrahedron (a, b, c, d), exact but for underflow: 1 if
 * (b - a, c - a, d - a) is right-handed. */
[[nodiscard]] int orientation(const Eigen::Vector3d& a,
                              const Eigen::Vector3d& b,
                              const Eigen::Vector3d& c,
                              const Eigen::Vector3d& d);

/** \brief Sign (-1, 0, 1) of the area of the triangle (a, b, c), likewise: 1 if it runs counter-clockwise. */
[[nodiscard]] int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c);

}  // namespace pds
