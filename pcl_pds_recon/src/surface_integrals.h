// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <vector>

#include <pcl_pds_recon/triangle_complex.h>

namespace pds
{

/** \brief What tells which side of some faces, which agree, is outside. */
struct SurfaceIntegrals
{
  double area = 0;
  Eigen::Vector3d area_vector = Eigen::Vector3d::Zero();  ///< sum of the faces' own
  double volume = 0;                                      ///< of the cone over the faces from their centroid

  /** \brief The surface is no shape that is nearly closed, but shows one side as a whole. */
  [[nodiscard]] bool faces_one_side() const { return area_vector.norm() > least_facing * area; }

  /** \brief The volume in that of a ball of the same area: positive if the faces look where the surface bulges to. */
  [[nodiscard]] double bulge() const;

 private:
  // Terrain with walls and trees has 0.3 and more, a shape that is nearly closed less than 0.1.
  static constexpr double least_facing = 0.15;
};

[[nodiscard]] SurfaceIntegrals integrate(const std::vector<Triangle>& triangles,
                                         const std::vector<Eigen::Vector3d>& position);

/** \brief A face's normal, as long as its area. */
[[nodiscard]] Eigen::Vector3d area_vector(const Triangle& triangle, const std::vector<Eigen::Vector3d>& position);

}  // namespace pds
