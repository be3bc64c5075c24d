// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pcl_pds_recon/neighbor_graph.h>

namespace pds
{

/** \brief True if it is noise, and not the shape of the surface, that keeps many points out of the planes of their
 * neighbours: noise looks thinner the wider one looks, a bend thicker and a crease the same.
 *
 * Looks at one point in 256, or a thousand points.
 * \param clean_points that were left out before, known to have no noise
 */
[[nodiscard]] bool is_noisy(const OrderedPoints& points,
                            const NeighborGraph& graph,
                            const Parallel& parallel,
                            std::size_t clean_points = 0);

/** \brief The points moved into the middle of their noise: onto the plane of their neighbours or, where noise fills
 * that neighbourhood, of their neighbours' neighbours. What all points around move by alike is the bend of the surface
 * and not noise: it is taken back.
 *
 * Layers of overlapping scans are drawn together. A graph of the result has the sampling interval of the surface, and
 * what is left of the noise can be smoothed again in wider neighbourhoods. O(n k), 36 bytes a point.
 */
[[nodiscard]] PointArray<Eigen::Vector3f> smooth_positions(const OrderedPoints& points,
                                                           const NeighborGraph& graph,
                                                           const Parallel& parallel);

/** \brief How much each point of a noisy cloud deserves to be a seed: 15 in the middle of the noise, 0 four mean
 * displacements off it.
 * \param points with smoothed positions; those of the cloud tell how far each was moved
 */
[[nodiscard]] std::vector<std::uint8_t> middle_ranks(const PointCloudView& cloud,
                                                     const OrderedPoints& points,
                                                     const Parallel& parallel);

}  // namespace pds
