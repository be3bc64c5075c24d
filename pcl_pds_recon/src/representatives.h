// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>

#include <pcl_pds_recon/ordered_points.h>
#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/point_array.h>

namespace pds
{

/** \brief For each point, by rank, the one that represents it: itself, or one that represents itself. */
using Representatives = PointArray<std::uint32_t>;

/** \brief How many represent themselves. */
[[nodiscard]] std::size_t count_representatives(const Representatives& representative, const Parallel& parallel);

/** \brief The points that represent themselves, in their order, and all that the others are represented by. */
[[nodiscard]] OrderedPoints keep_representatives(OrderedPoints points,
                                                 const Representatives& representative,
                                                 const Parallel& parallel);

}  // namespace pds
