// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/ply_writer.h"
#include "io/point_table.h"

#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/triangle_mesh.h>

#include <string>
#include <vector>

namespace pds
{

/** \brief A mesh as it stood in a file: its vertices with all their fields, and its faces; or a cloud without any. */
struct MeshFile
{
  PointTable points;
  Triangles triangles;  ///< of polygons: fans of triangles around their first corner
};

/** \brief Reads a mesh from .ply .obj .stl and, in a build with VTK, .vtk .vtp, or a cloud from any format of
 * read_points(). Coincident corners of an STL file, which has no vertices, become one.
 * \throws InvalidInput with one line that names the file, what is wrong and how to mend it
 */
[[nodiscard]] MeshFile read_mesh_file(const std::string& path, const Parallel& parallel);

/** \brief The extensions of read_mesh_file(). */
[[nodiscard]] std::vector<std::string> readable_extensions();

/** \brief What the library's functions on meshes take. */
[[nodiscard]] TriangleMesh to_mesh(const MeshFile& file);

}  // namespace pds
