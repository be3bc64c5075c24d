// SPDX-License-Identifier: BSD-3-Clause
#include "io/write_mesh.h"

#ifdef PCL_PDS_RECON_WITH_VTK
#include "io/vtk_writer.h"
#endif

namespace pds
{

std::vector<std::string> mesh_extensions()
{
#ifdef PCL_PDS_RECON_WITH_VTK
  return {".ply", ".obj", ".stl", ".vtk", ".vtp"};
#else
  return {".ply"};
#endif
}

std::string lost_in_format(const std::string& extension, const PointTable& points, bool ascii)
{
  const bool is_stl = extension == ".stl";
  std::string lost;
  if (is_stl || extension == ".obj") {
    for (const Field& field : points.fields()) {
      const bool is_position = field.name == "x" || field.name == "y" || field.name == "z";
      const bool is_normal = field.name == "nx" || field.name == "ny" || field.name == "nz";
      const bool is_held = is_position || (is_normal && points.has_normals() && !is_stl);
      lost += is_held ? "" : (lost.empty() ? "the fields " : " ") + field.name;
    }
  }
  const bool rounds = points.has_double_positions() && (is_stl || (extension == ".vtk" && ascii));
  if (rounds) {
    lost += std::string(lost.empty() ? "" : " and ") + "the last digits of double coordinates";
  }
  return lost;
}

void write_mesh(
    AtomicFile& file, const std::string& extension, const PointTable& points, const Triangles& triangles, bool ascii)
{
  if (extension == ".ply") {
    write_ply(file, points, triangles, ascii);
    return;
  }
#ifdef PCL_PDS_RECON_WITH_VTK
  write_with_vtk(file, extension, points, triangles, ascii);
#else
  throw OutputError("this build has no VTK and writes no '" + extension + "'; write .ply");
#endif
}

}  // namespace pds
