// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <cstdint>
#include <vector>

namespace pds
{

/** \brief The points of these classes: those whose field "classification", "class" or CloudCompare's
 * "scalar_Classification", in any case, is one of \a classes.
 * \throws InvalidInput if there is no such field, or naming the classes that are there if none is wanted
 */
[[nodiscard]] PointTable select_classes(PointTable points, const std::vector<std::uint8_t>& classes);

}  // namespace pds
