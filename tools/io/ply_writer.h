// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/atomic_file.h"
#include "io/point_table.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pds
{

using Triangles = std::vector<std::array<std::uint32_t, 3>>;
using Segments = std::vector<std::array<std::uint32_t, 2>>;  ///< edges of curves

/** \brief Writes points with all their fields, and faces and edges of curves if there are any, as PLY.
 * \param ascii decimal numbers, as many digits as give the same bits back; otherwise binary, little endian
 * \throws OutputError if the file cannot be written
 */
void write_ply(
    AtomicFile& file, const PointTable& points, const Triangles& triangles, bool ascii, const Segments& segments = {});

}  // namespace pds
