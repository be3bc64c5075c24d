// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/byte_source.h"

namespace pds
{

/** \brief Checks a LAZ file before PDAL reads it: PDAL takes the header's word for the number of points and reads
 * beyond the last one if that is wrong. \throws InvalidInput if it is not a LAZ file, is cut short, or its header
 * announces more points than its chunks hold
 */
void check_laz(const ByteSource& source);

}  // namespace pds
