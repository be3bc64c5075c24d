// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <pcl_pds_recon/neighbor_graph.h>

namespace pds
{

/** \brief Points that belong to no surface: strays, spray, flying pixels between an edge and what is behind it.
 *
 * A point's reach is the distance of its last neighbour. An outlier is a point whose reach is far beyond that of its
 * own neighbours, or that is far from all others and has no plane through its neighbours. A surface that is scanned
 * more coarsely than the rest is neither. Where there are such points, some are near the surface by chance: those that
 * stand off the plane of their neighbours alone go as well. Of a crease other points do, too, and of noise.
 * \return by rank: 1 for an outlier; empty if there are too few to matter
 */
[[nodiscard]] std::vector<std::uint8_t> find_outliers(const OrderedPoints& points,
                                                      const NeighborGraph& graph,
                                                      const Parallel& parallel);

/** \brief The points without the outliers, in their order. */
[[nodiscard]] OrderedPoints without_outliers(OrderedPoints points,
                                             const std::vector<std::uint8_t>& outlier,
                                             const Parallel& parallel);

}  // namespace pds
