// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/ply_writer.h"

namespace pds
{

/** \brief Writes a mesh as STL: facets with their normals, coordinates in float.
 *
 * VTK's writer does not notice in every case that the disk is full.
 * \param ascii text instead of binary
 * \throws OutputError if the file cannot be written
 */
void write_stl(AtomicFile& file, const PointTable& points, const Triangles& triangles, bool ascii);

}  // namespace pds
