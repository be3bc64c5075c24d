// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/ply_writer.h"

#include <string>

namespace pds
{

/** \brief A mesh and the edges of curves as binary glTF 2.0 (.glb), as browsers and Blender open it: positions, normals
 * and colours.
 *
 * glTF has single-precision positions only, so those of a double-precision cloud are relative to the middle of the
 * mesh, whose place is the translation of its node. If z is up in the cloud the node also turns the mesh, since y is up
 * in glTF; otherwise axes are those of the cloud. Colours are taken for sRGB, as scanners and cameras write them, and
 * made linear, as glTF wants them.
 *
 * VTK 9.1 has two writers, which will not do: vtkGLTFExporter writes text, even under a name that ends in .glb, rounds
 * UTM coordinates to half a metre, since it places nothing by the node, leaves colours in sRGB, and exports the scene
 * of a render window, camera included; vtkGLTFWriter takes the buildings of CityGML. \throws
 * OutputError if the mesh is too large for the format
 */
[[nodiscard]] std::string make_glb(const PointTable& points, const Triangles& triangles, const Segments& segments = {});

/** \brief Likewise into a file. \throws OutputError also if the file cannot be written */
void write_glb(AtomicFile& file, const PointTable& points, const Triangles& triangles, const Segments& segments = {});

}  // namespace pds
