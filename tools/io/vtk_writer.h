// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/ply_writer.h"

#include <string>

namespace pds
{

/** \brief Writes .vtk or .vtp. Every field is a named array of the points; colours are RGB, normals Normals.
 * \throws OutputError if the file cannot be written
 */
void write_with_vtk(
    AtomicFile& file, const std::string& extension, const PointTable& points, const Triangles& triangles, bool ascii);

}  // namespace pds
