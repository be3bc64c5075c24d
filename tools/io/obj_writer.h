// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/ply_writer.h"

namespace pds
{

/** \brief Writes a mesh and the edges of curves as Wavefront OBJ with all digits of its coordinates, normals, and
 * colours as "v x y z r g b".
 *
 * VTK's writer does not notice that the disk is full and knows no colours.
 * \throws OutputError if the file cannot be written
 */
void write_obj(AtomicFile& file, const PointTable& points, const Triangles& triangles, const Segments& segments = {});

}  // namespace pds
