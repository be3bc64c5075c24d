// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include <pcl_pds_recon/geodesic_voronoi.h>

namespace pds
{

/** \brief Seeds as the vertices of a mesh in the making. */
struct SeedGeometry
{
  std::vector<Eigen::Vector3d> position;  ///< in radii, so that every length in the later stages is in radii
  std::vector<Eigen::Vector3d> normal;    ///< unit, of arbitrary sign: principal axis of the cell's point normals
  std::vector<double> curvature;          ///< mean over the cell, see SurfaceEstimate
};

/** \brief Graph of adjacent seeds that is planar in every tangent plane (paper, flowchart step 7). */
struct SeedGraph
{
  std::vector<std::size_t> begin;       ///< by seed: its first place in neighbor; size seeds + 1
  std::vector<std::uint32_t> neighbor;  ///< counter-clockwise about the seed's normal
};

[[nodiscard]] SeedGeometry describe_seeds(const PointCloudView& cloud,
                                          const OrderedPoints& points,
                                          const SurfaceEstimate& surface,
                                          const PoissonDiskSampling& sampling,
                                          const GeodesicVoronoi& voronoi,
                                          const Parallel& parallel);

/** \brief Joins bordering seeds, best evidence first (witnesses, then shortest path), unless the edge would cross one
 * that is already there in the tangent plane between its ends. O(edges). */
[[nodiscard]] SeedGraph build_seed_graph(const SeedGeometry& seeds,
                                         const std::vector<SeedPair>& pairs,
                                         const Parallel& parallel);

}  // namespace pds
