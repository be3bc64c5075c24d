// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/byte_source.h"
#include "io/point_table.h"

#include <pcl_pds_recon/parallel.h>

namespace pds
{

/** \brief Reads the vertices of a PLY file: ascii or binary of either byte order, every scalar property.
 *
 * List properties and other elements are not read, which the table says. Positions that are neither float nor double
 * become double. \throws InvalidInput if the file is not a PLY file, is cut short or holds a value that does not fit
 * its type
 */
[[nodiscard]] PointTable read_ply(const ByteSource& source, const Parallel& parallel);

}  // namespace pds
