// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/mesh_file.h"

#include <string_view>

namespace pds
{

/** \brief The faces of a PLY file in memory. \throws InvalidInput if they are damaged */
[[nodiscard]] Triangles read_ply_faces(std::string_view file);

/** \brief The faces of an OBJ file in memory. \throws InvalidInput naming the line that is wrong */
[[nodiscard]] Triangles read_obj_faces(std::string_view file);

/** \brief A mesh from an STL file in memory, text or binary. \throws InvalidInput if it is damaged */
[[nodiscard]] MeshFile read_stl(std::string_view file);

/** \brief Adds a polygon as a fan of triangles. \throws InvalidInput if it has fewer than three corners */
void add_polygon(const std::vector<std::uint32_t>& corners, Triangles& triangles);

}  // namespace pds
