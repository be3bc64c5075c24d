// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <pcl_pds_recon/parallel.h>

#include <string>

namespace pds
{

/** \brief Reads a point cloud in the format of its extension: .pcd .ply .las .obj .xyz .txt .csv, in any case, and in a
 * build with PDAL .laz (COPC too) and .e57; PCD or PLY from standard input if \a path is "-".
 * \throws InvalidInput with one line that names the file, what is wrong and how to mend it
 */
[[nodiscard]] PointTable read_points(const std::string& path, const Parallel& parallel);

}  // namespace pds
