// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/edge_weights.h>

#include <cstddef>

#include "instruction_set.h"

namespace pds
{

/** \brief Fits planes to the points \a begin ... \a end - 1 and their own neighbours: the direction in which these
 * spread least, and the square root of the share of the spread that is along it.
 *
 * Directions are eigenvectors of the covariance matrix. Eigenvalues are exact to 1e-7 of the largest one. Every
 * instruction set gives the same bits.
 * \param surface receives the results at the points' places: zeros if a point has fewer than two neighbours
 */
void fit_planes(InstructionSet set,
                const OrderedPoints& points,
                const NeighborGraph& graph,
                std::size_t begin,
                std::size_t end,
                SurfaceEstimate& surface);

}  // namespace pds
