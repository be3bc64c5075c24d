// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <vector>

#include <pcl_pds_recon/edge_weights.h>
#include <pcl_pds_recon/neighbor_graph.h>
#include <pcl_pds_recon/options.h>
#include <pcl_pds_recon/ordered_points.h>

namespace pds
{

/** \brief The nearest seeds of a point, nearest first: where several disks overlap, the Voronoi diagram shows. */
struct NearestSeeds
{
  static constexpr std::size_t capacity = 3;          ///< three meet at a Voronoi vertex
  static constexpr std::uint32_t none = 0xffffffffU;  ///< marks a place without a seed

  static constexpr float infinity = std::numeric_limits<float>::infinity();  ///< of a place without a seed

  std::array<std::uint32_t, capacity> seed;  ///< by ascending distance
  std::array<float, capacity> distance;      ///< to each, in the run's metric

  /** \brief Of a point that no disk has reached. Not what the type begins with: arrays of it are filled in parallel. */
  [[nodiscard]] static NearestSeeds unknown() { return {{none, none, none}, {infinity, infinity, infinity}}; }

  /** \brief True if a disk of this radius around some seed covers the point. */
  [[nodiscard]] bool covered(float radius) const { return distance[0] <= radius; }
  /** \brief Adds a seed that is not named yet, if it is nearer than the last one. Branch-free but for that. */
  void insert(std::uint32_t new_seed, float new_distance)
  {
    if (new_distance >= distance[2]) return;
    const bool first = new_distance < distance[0];
    const bool second = new_distance < distance[1];
    distance[2] = second ? distance[1] : new_distance;
    seed[2] = second ? seed[1] : new_seed;
    distance[1] = first ? distance[0] : second ? new_distance : distance[1];
    seed[1] = first ? seed[0] : second ? new_seed : seed[1];
    distance[0] = first ? new_distance : distance[0];
    seed[0] = first ? new_seed : seed[0];
  }

  /** \brief Adds a seed, or brings it nearer if it is named already. */
  void insert_or_approach(std::uint32_t new_seed, float new_distance)
  {
    for (std::size_t place = 0; place < capacity; ++place) {
      if (seed[place] != new_seed) continue;
      if (distance[place] <= new_distance) return;
      for (; place + 1 < capacity; ++place) {
        seed[place] = seed[place + 1];
        distance[place] = distance[place + 1];
      }
      seed[place] = none;
      distance[place] = infinity;
    }
    insert(new_seed, new_distance);
  }
};

/** \brief Poisson-disk samples of a cloud. */
struct PoissonDiskSampling
{
  std::vector<std::uint32_t> seeds;  ///< ranks, ascending
  PointArray<NearestSeeds> nearest;  ///< per point; seeds are named by their place in \a seeds
  double radius = 0;                 ///< in units of position, in the run's metric
};

/** \brief How far beyond the radius disks are grown, in radii: a point near a Voronoi vertex then knows all three seeds
 * although distances measured from either side differ a little. */
constexpr double disk_reach = 1.25;

/** \brief Seeds that are there before the first dart, however close to each other. */
struct GivenSeeds
{
  std::vector<std::uint32_t> ranks;  ///< ascending
  double coverage = 1.0;             ///< darts are thrown at points farther from all seeds; in radii, up to disk_reach
};

/** \brief What makes the number of seeds change with the radius bit by bit, as a search for it needs. */
struct SteadyCount
{
  /** Each point draws a radius of its own, which is greater by up to this share, and is a dart while no seed is within
   * it: of those that are equally far from seeds some become seeds. Less than disk_reach - 1. */
  double spread = 0;
  double radius_of_cells = 0;  ///< the cells stay those of this radius, if it is the greater one
};

/** \brief Dart throwing over geodesic disks (paper, flowchart steps 2 to 5).
 *
 * The distance of two points is the smaller of those measured from either. Space is cut into cells of four times the
 * reach, coloured with 2 x 2 x 2 colours: disks of different cells of one colour cannot meet, because no distance is
 * below the Euclidean one. Colours are worked through in turn, the cells of one in parallel, the points of a cell in an
 * order of descending feature rank, drawn among equals by hashing their coordinates: the result depends on nothing
 * else.
 *
 * \param feature_rank per point: those of at least crease_rank are tried before all others, and points of a higher rank
 * before others of their cell
 * \param radius in units of position
 * \param seed picks the order
 * \param given seeds before the first dart
 * \param steady by default all points have the same radius, and cells fit it
 */
[[nodiscard]] PoissonDiskSampling sample_poisson_disks(const OrderedPoints& points,
                                                       const NeighborGraph& graph,
                                                       const SurfaceEstimate& surface,
                                                       const EdgeWeights& weights,
                                                       const std::vector<std::uint8_t>& feature_rank,
                                                       double radius,
                                                       GeodesicSolver solver,
                                                       std::uint64_t seed,
                                                       const Parallel& parallel,
                                                       const GivenSeeds& given = {},
                                                       const SteadyCount& steady = {});

}  // namespace pds
