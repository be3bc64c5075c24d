// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <pcl_pds_recon/poisson_disk_sampling.h>

namespace pds
{

/** \brief Longest edge of the mesh, in radii, or in those that the points would need where they are farther apart than
 * the radius allows. Two disks that overlap give at most 2 disk_reach; where the points thin out, cells touch across
 * wider spaces. */
constexpr double longest_dual_edge = 3.9;

/** \brief Evidence that the Voronoi cells of two seeds share a border. */
struct SeedPair
{
  std::uint32_t a;          ///< one seed
  std::uint32_t b;          ///< the other; a < b
  std::uint32_t witnesses;  ///< witness points on the border (the paper's criterion)
  float path;               ///< shortest way from seed to seed across the border; units of position, run's metric
};

/** \brief Evidence that the Voronoi cells of three seeds meet. */
struct SeedTriple
{
  std::uint32_t a;      ///< one seed
  std::uint32_t b;      ///< another; a < b
  std::uint32_t c;      ///< the third; b < c
  std::uint32_t votes;  ///< points that see all three cells next to each other
};

/** \brief Geodesic Voronoi diagram of the seeds, discrete: every point belongs to its nearest seed's cell. */
struct GeodesicVoronoi
{
  std::vector<std::size_t> cell_begin;   ///< by seed: begin of its points in cell_point; size seeds + 1
  PointArray<std::uint32_t> cell_point;  ///< ranks, ascending within a cell
  PointArray<std::uint8_t> witness;      ///< per point: 1 if it lies near a Voronoi edge
  std::vector<SeedPair> pairs;           ///< ascending by (a, b)
  std::vector<SeedTriple> triples;       ///< ascending by (a, b, c)
  std::vector<float> sparsity;  ///< by seed: the radius that the points around it would need, in radii; 1 or more
};

/** \brief Finds cells, witness points, bordering pairs and meeting triples (paper, flowchart steps 6 and 7).
 *
 * A witness lies in the disks of its two nearest seeds at distances that differ by less than the threshold. Short
 * Voronoi edges have no witness; there, points count whose nearest neighbours lie in other cells. O(n k).
 * \param threshold in radii
 */
[[nodiscard]] GeodesicVoronoi build_geodesic_voronoi(const OrderedPoints& points,
                                                     const NeighborGraph& graph,
                                                     const EdgeWeights& weights,
                                                     const PoissonDiskSampling& sampling,
                                                     double threshold,
                                                     const Parallel& parallel);

}  // namespace pds
