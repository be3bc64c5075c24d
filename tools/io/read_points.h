// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <pcl_pds_recon/parallel.h>

#include <string>

namespace pds
{

/** \brief Reads a point cloud in the format of its extension: .pcd .ply .obj .xyz .txt .csv, in any case.
 * \throws InvalidInput with one line that names the file, what is wrong and how to mend it
 */
[[nodiscard]] PointTable read_points(const std::string& path, const Parallel& parallel);

}  // namespace pds
