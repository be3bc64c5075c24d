// SPDX-License-Identifier: BSD-3-Clause
#include "surface_integrals.h"

#include <Eigen/Geometry>
#include <cmath>

namespace pds
{

using Eigen::Vector3d;

Vector3d area_vector(const Triangle& t, const std::vector<Vector3d>& position)
{
  return 0.5 * (position[t[1]] - position[t[0]]).cross(position[t[2]] - position[t[0]]);
}

double SurfaceIntegrals::bulge() const
{
  constexpr double pi = 3.14159265358979323846;
  return area > 0 ? 6 * std::sqrt(pi) * volume / std::pow(area, 1.5) : 0;
}

SurfaceIntegrals integrate(const std::vector<Triangle>& triangles, const std::vector<Vector3d>& position)
{
  SurfaceIntegrals sums;
  Vector3d centroid = Vector3d::Zero();
  for (const Triangle& t : triangles) {
    const Vector3d of_face = area_vector(t, position);
    sums.area_vector += of_face;
    sums.area += of_face.norm();
    centroid += of_face.norm() * (position[t[0]] + position[t[1]] + position[t[2]]) / 3.0;
  }
  if (sums.area > 0) centroid /= sums.area;
  for (const Triangle& t : triangles) sums.volume += area_vector(t, position).dot(position[t[0]] - centroid) / 3.0;
  return sums;
}

}  // namespace pds
