// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace pds
{

/** \brief The part of a triangle that a point lies on. */
enum class TrianglePart : std::uint8_t
{
  corner_0,
  corner_1,
  corner_2,
  edge_01,
  edge_12,
  edge_20,
  inside
};

struct ClosestOnTriangle
{
  Eigen::Vector3d point;
  TrianglePart part;
};

/** \brief The point of triangle (a, b, c) nearest to \a p (Ericson, Real-Time Collision Detection, 5.1.5). The triangle
 * may be a single point, but not otherwise without area. */
[[nodiscard]] ClosestOnTriangle closest_on_triangle(const Eigen::Vector3d& p,
                                                    const Eigen::Vector3d& a,
                                                    const Eigen::Vector3d& b,
                                                    const Eigen::Vector3d& c);

}  // namespace pds
