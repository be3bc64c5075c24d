// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/byte_source.h"
#include "io/point_table.h"

#include <pcl_pds_recon/parallel.h>

namespace pds
{

/** \brief Reads a PCD file, ascii, binary or compressed: every field, and the sensor origin if the file has a viewpoint
 * of its own.
 *
 * Names become those of PLY: packed rgb or rgba is unpacked to red green blue (alpha), normal_x is nx, and a field of
 * several scalars is numbered from name_0.
 *
 * PCL's own reader needs the cloud twice in memory and takes six times as long, asks for the memory that a header
 * announces before it looks at the data, and takes rows of a text that are too short or no numbers for zeros.
 * \throws InvalidInput if the file is not a PCD file, is cut short or damaged, naming the row of a text that is wrong
 */
[[nodiscard]] PointTable read_pcd(const ByteSource& source, const Parallel& parallel);

}  // namespace pds
