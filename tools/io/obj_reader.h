// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <string_view>

namespace pds
{

/** \brief Reads the 'v' lines of a Wavefront OBJ file in memory, positions in double. Everything else is passed over.
 *
 * If every line has six or more numbers, the last three are a colour in 0 ... 1 and become red, green and blue.
 * \throws InvalidInput naming a line that is wrong
 */
[[nodiscard]] PointTable read_obj(std::string_view file);

}  // namespace pds
