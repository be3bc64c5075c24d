// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/geodesic_voronoi.h>
#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/point_array.h>
#include <pcl_pds_recon/poisson_disk_sampling.h>
#include <pcl_pds_recon/triangle_complex.h>
#include <Eigen/Core>
#include <vector>
#include "mesh_fans.h"

namespace pds
{

/** \brief Sum of squared distances of points from a face, as a function of how far its corners move along its normal.
 *
 * A point with barycentric coordinates l and height h above the face is h - l.u above it once the corners have moved by
 * u: the sum is u.weight.u - 2 pull.u + square. */
struct FaceQuadric
{
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  ///< unit
  Eigen::Matrix3d weight = Eigen::Matrix3d::Zero();  ///< sum of l l^T
  Eigen::Vector3d pull = Eigen::Vector3d::Zero();    ///< sum of h l
  double square = 0;                                 ///< sum of h^2
  std::size_t points = 0;
};

/** \brief The quadric of every face, of the points that are nearest to it. A point is looked for among the faces at its
 * seed: others are seldom nearer. O(points / stride).
 * \param position of the seeds, in radii
 * \param stride only every so many points of a cell are looked at */
[[nodiscard]] std::vector<FaceQuadric> measure_face_quadrics(const std::vector<Eigen::Vector3d>& position,
                                                             const std::vector<Triangle>& triangles,
                                                             const MeshFans& fans,
                                                             const PointArray<Eigen::Vector3f>& points,
                                                             const PoissonDiskSampling& sampling,
                                                             const GeodesicVoronoi& voronoi,
                                                             std::size_t stride,
                                                             const Parallel& parallel);

}  // namespace pds
