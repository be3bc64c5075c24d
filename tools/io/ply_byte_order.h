// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/ply_header.h"

namespace pds
{

/** \brief Asks whether the coordinates of a binary PLY file, read as its header says, make sense.
 *
 * Coordinates are zero or some number that a scene has in any unit, whereas floating-point numbers whose bytes are
 * turned around are of any magnitude, mostly far too great or small. The file is believed unless most of a sample do
 * not make sense and most would if turned around; integers and fewer than twelve numbers are believed, too.
 * \param points the vertices as they have been read
 * \throws InvalidInput if the byte order in the header is the wrong one
 */
void check_ply_byte_order(const PlyHeader& header, const PlyElement& vertex, const PointTable& points);

}  // namespace pds
