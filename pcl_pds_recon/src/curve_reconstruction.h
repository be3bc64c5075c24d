// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/reconstruction.h>

namespace pds
{

/** \brief As reconstruct(), for points of curves: polylines instead of triangles. Components of the neighbourhood graph
 * that look like a line at no scale are left out as outliers. */
[[nodiscard]] Reconstruction reconstruct_curves(const PointCloudView& cloud,
                                                const Options& options,
                                                const Progress& progress);

}  // namespace pds
