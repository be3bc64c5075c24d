// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <pcl_pds_recon/edge_weights.h>
#include <pcl_pds_recon/neighbor_graph.h>
#include <pcl_pds_recon/point_cloud_view.h>

namespace pds
{

/** \brief What separate_sheets() found, in points. */
struct SheetCounts
{
  std::size_t parted = 0;    ///< with a second sheet beside theirs
  std::size_t too_near = 0;  ///< that seem to have one, but no farther away than noise is thick elsewhere
};

/** \brief Parts two sheets that are nearer to each other than neighbours reach: the sides of a thin plate, or surfaces
 * that nearly touch.
 *
 * A point has a second sheet beside its own if the points around lie in two parallel planes with nothing in between;
 * the noise of a scan fills what is between its layers, and if the cloud has normals, those of the two sheets face
 * away from each other. Rows lose the points of the other sheet, and those of such points are filled up with more
 * points of their own. Without normals sheets must be farther apart than noise is thick elsewhere, if it is usual in
 * the cloud. O(n), and some microseconds for each point whose neighbourhood is no plane.
 * \param graph of which the rows are known; they are joined afterwards
 * \param surface of the graph, fitted anew where rows change
 * \param candidate by point, 0 if it is known to have no second sheet; empty: all may
 */
SheetCounts separate_sheets(const PointCloudView& cloud,
                            const OrderedPoints& points,
                            NeighborGraph& graph,
                            SurfaceEstimate& surface,
                            const Parallel& parallel,
                            const std::vector<std::uint8_t>& candidate = {});

}  // namespace pds
