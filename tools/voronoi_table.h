// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <pcl_pds_recon/reconstruction.h>

namespace pds
{

/** \brief The cloud with its geodesic Voronoi diagram, as in the paper's Fig. 3.
 *
 * Added fields, in place of any of the same name: label (int, the seed of the cell; -1: none), distance (float, to that
 * seed), witness (uchar, 1 near a Voronoi edge) and seed (uchar, 1 for seeds).
 */
[[nodiscard]] PointTable make_voronoi_table(const PointTable& points,
                                            const Reconstruction& result,
                                            const Parallel& parallel);

}  // namespace pds
