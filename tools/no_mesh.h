// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <pcl_pds_recon/options.h>
#include <pcl_pds_recon/report.h>

#include <string>

namespace pds
{

/** \brief What is wrong with a cloud that gave neither faces nor curves, and how to mend it. */
[[nodiscard]] std::string why_no_mesh(const PointTable& points, const Report& report, Dimension dimension);

}  // namespace pds
