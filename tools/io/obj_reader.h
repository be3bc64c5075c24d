// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <string_view>

namespace pds
{

/** \brief Reads the vertices of a Wavefront OBJ file in memory: positions and normals in double, and colours.
 *
 * The last three of six or more numbers of a vertex are its colour. It is of 8 or 16 bits if it could have been written
 * from those. Not read is what no vertex has, and normals or colours that not every vertex has.
 * \throws InvalidInput naming a line that is wrong
 */
[[nodiscard]] PointTable read_obj(std::string_view file);

}  // namespace pds
