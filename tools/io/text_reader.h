// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <string_view>

namespace pds
{

/** \brief Reads a text file in memory: one point a line, columns parted by blanks, tabs, commas or semicolons.
 *
 * Empty lines and lines starting with '#' or '//' are passed over. The columns are named by the first line that is not
 * a row of numbers, or by a comment before the first row that lists x, y, z and as many names as there are columns.
 * Without names the first three columns are x y z; then, from left to right, three columns of whole numbers in
 * 0 ... 255, not all below 2, are red green blue; three that form unit vectors are nx ny nz; any other is intensity,
 * and after it field_5, field_6, ... by the number of the column. So 4, 6 and 7 columns are mostly "x y z intensity",
 * "x y z red green blue" or "x y z nx ny nz", and "x y z red green blue intensity".
 * Everything is read in double; colours in 0 ... 255 become bytes.
 * \throws InvalidInput naming the line that is wrong
 */
[[nodiscard]] PointTable read_text(std::string_view file);

}  // namespace pds
