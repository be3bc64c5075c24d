// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/mesh_file.h"

namespace pds
{

/** \brief Reads a mesh from a .vtk or .vtp file: its vertices, polygons and strips. Lines and fields are passed over.
 * \throws InvalidInput if it is damaged
 */
[[nodiscard]] MeshFile read_with_vtk(const std::string& path);

}  // namespace pds
