// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/byte_source.h"
#include "io/las_header.h"

namespace pds
{

/** \brief Where a LAZ file has what is needed to unpack its points. */
struct LazParts
{
  LasHeader header;
  std::size_t table_at = 0;  ///< of the table of chunks, which begins where the last chunk ends
};

/** \brief Checks what a LAZ file says about itself before PDAL takes its word for it: a number of points, a length of
 * records or a size of chunks that is wrong makes PDAL invent points or crash.
 *
 * In the point formats from 6 on each chunk says how many points it holds, so that their number is certain; of the
 * others only unpacking shows it: LazCopy lets whoever takes too many run against the end of the file, and whoever
 * takes too few do without its last byte. \throws InvalidInput if it is not a LAZ file, is cut short, or its header,
 * LASzip record and chunks do not agree
 */
LazParts check_laz(const ByteSource& source);

}  // namespace pds
