// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pds
{

using ByteColor = std::array<std::uint8_t, 3>;  ///< red, green, blue

/** \brief The colours of the points as a screen shows them; empty if they have none. */
[[nodiscard]] std::vector<ByteColor> byte_colors(const PointTable& points);

}  // namespace pds
