// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <string>
#include <string_view>

namespace pds
{

/** \brief Reads a PCD file with PCL: every field, and the sensor origin if the file has a viewpoint of its own.
 *
 * Names become those of PLY: packed rgb or rgba is unpacked to red green blue (alpha), normal_x is nx, and a field of
 * several scalars is numbered from name_0. Scalars of 64-bit integers become double.
 * \param path the file, for PCL
 * \param file its bytes, which are checked before PCL reads it
 * \throws InvalidInput if the file is not a PCD file, is cut short or PCL cannot read it
 */
[[nodiscard]] PointTable read_pcd(const std::string& path, std::string_view file);

}  // namespace pds
