// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/byte_source.h"
#include "io/point_table.h"

#include <pcl_pds_recon/parallel.h>

namespace pds
{

/** \brief Reads a LAS file that is not compressed, version 1.0 to 1.4: every field of its point format.
 *
 * Coordinates are doubles, scale times integer plus offset, as the standard defines them. The other names are PDAL's in
 * snake case: intensity, return_number, number_of_returns, classification, scan_angle (degrees), user_data,
 * point_source_id, gps_time, red green blue, infrared, and a byte for each flag. Colours become bytes if that loses
 * nothing, as in files that store 8 bits in 16: spread by 257 or 256 or, against the standard but often met, not at
 * all. So a file of 16 bits whose colours are all below 256, too dark to see, is taken for one of 8. Extra bytes become
 * fields of their names in snake case, doubles if they have a scale or an offset. Debian 12 has no library that reads
 * LAS.
 *
 * \throws InvalidInput if the file is not a LAS file, is compressed, cut short or damaged
 */
[[nodiscard]] PointTable read_las(const ByteSource& source, const Parallel& parallel);

}  // namespace pds
