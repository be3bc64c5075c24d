// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Geometry>
#include <cmath>

#include "shapes.h"

/** \brief Points on regular grids, as CAD faces, terrain and voxels have them: few distances, and many of each. */
namespace pds_test
{

/** \brief A rectangle in the plane z = 0, points a unit apart. */
inline Points flat_grid(int columns, int rows)
{
  Points points;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) points.emplace_back(i, j, 0);
  return points;
}

/** \brief Rows shifted by half a step: every point has six neighbours at a unit's distance. */
inline Points hexagonal_grid(int columns, int rows)
{
  Points points;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) points.emplace_back(i + 0.5 * (j % 2), j * std::sqrt(0.75), 0);
  return points;
}

/** \brief The integer points on the surface of a cube of this side. */
inline Points cube_of_grids(int side)
{
  Points points;
  for (int i = 0; i <= side; ++i)
    for (int j = 0; j <= side; ++j)
      for (int k = 0; k <= side; ++k)
        if (i % side == 0 || j % side == 0 || k % side == 0) points.emplace_back(i, j, k);
  return points;
}

/** \brief The integer points within half a unit of a sphere. */
inline Points voxel_sphere(int radius)
{
  Points points;
  const int reach = radius + 1;
  for (int i = -reach; i <= reach; ++i)
    for (int j = -reach; j <= reach; ++j)
      for (int k = -reach; k <= reach; ++k)
        if (std::abs(Eigen::Vector3d(i, j, k).norm() - radius) < 0.5) points.emplace_back(i, j, k);
  return points;
}

/** \brief Hills over a grid, their heights whole multiples of a step. */
inline Points hills_on_grid(int side, double step)
{
  Points points = flat_grid(side, side);
  for (Eigen::Vector3d& p : points) {
    const double height =
        6 * std::sin(0.05 * p.x()) * std::cos(0.04 * p.y()) + 2 * std::sin(0.17 * p.x() + 0.11 * p.y());
    p.z() = step * std::round(height / step);
  }
  return points;
}

/** \brief Turned about an axis of no importance, which leaves equal distances equal but for rounding. */
inline Points turned(Points points)
{
  const Eigen::AngleAxisd turn(0.7, Eigen::Vector3d(1, 2, 3).normalized());
  for (Eigen::Vector3d& p : points) p = turn * p;
  return points;
}

}  // namespace pds_test
