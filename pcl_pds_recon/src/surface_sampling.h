// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/neighbor_graph.h>
#include <pcl_pds_recon/parallel.h>

namespace pds
{

/** \brief False if most points have all of their neighbours along one line, or in one clump: rows of a line scanner
 * that are far apart, or many frames of a sensor that did not move, whose points lie along its rays.
 *
 * The neighbours of a point's neighbours go twice as far as these. On a surface they are therefore some three times as
 * many, on a line twice, and in a clump hardly more. Looks at 256 points. True for few neighbours, which cannot tell.
 */
[[nodiscard]] bool is_sampled_as_surface(const NeighborGraph& graph, const Parallel& parallel);

}  // namespace pds
