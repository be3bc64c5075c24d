// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <pcl_pds_recon/poisson_disk_sampling.h>

namespace pds
{

/** \brief By seed, where points are too far apart for the radius: the radius that their distances would need for whole
 * cells, in radii; 1 elsewhere. There all points become seeds, and the edges of the mesh are as long as the points are
 * apart. O(seeds + k^2 for each small cell).
 * \param cell_begin of GeodesicVoronoi */
[[nodiscard]] std::vector<float> local_sparsity(const OrderedPoints& points,
                                                const NeighborGraph& graph,
                                                const PoissonDiskSampling& sampling,
                                                const std::vector<std::size_t>& cell_begin,
                                                const Parallel& parallel);

}  // namespace pds
