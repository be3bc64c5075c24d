// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/reconstruction.h>

namespace pds
{

/** \brief As reconstruct(), for Dimension::curve and Dimension::automatic. */
[[nodiscard]] Reconstruction reconstruct_curves_too(const PointCloudView& cloud,
                                                    const Options& options,
                                                    const Progress& progress);

}  // namespace pds
