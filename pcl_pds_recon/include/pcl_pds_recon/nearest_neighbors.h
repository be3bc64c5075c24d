// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/point_array.h>

namespace pds
{

/** \brief k nearest neighbours of every point of a set in Morton order, the point itself left out.
 *
 * Consecutive points are searched together; nothing is built but a tree of boxes over them, 3.2 bytes a point.
 * \param position points in Morton order (any order is correct, others are slower)
 * \param k neighbours wanted; there must be more than k points
 * \return row i, of k entries: the neighbours of point i by ascending distance, equal distances by ascending index
 */
[[nodiscard]] PointArray<std::uint32_t> nearest_neighbors(const PointArray<Eigen::Vector3f>& position,
                                                          std::size_t k,
                                                          const Parallel& parallel);

/** \brief A point, and the mean distance to its k nearest neighbours. */
struct NeighborDistance
{
  std::uint32_t point;  ///< its rank
  float mean;           ///< distance, in units of position
};

/** \brief The same search for some 16,000 points that are spread evenly over the order, or all if there are fewer. */
[[nodiscard]] PointArray<NeighborDistance> sample_neighbor_distances(const PointArray<Eigen::Vector3f>& position,
                                                                     std::size_t k,
                                                                     const Parallel& parallel);

}  // namespace pds
