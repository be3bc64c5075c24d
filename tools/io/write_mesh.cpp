// SPDX-License-Identifier: BSD-3-Clause
#include "io/write_mesh.h"

#include "io/obj_writer.h"
#include "io/stl_writer.h"

#include <algorithm>

#ifdef PCL_PDS_RECON_WITH_VTK
#include "io/vtk_writer.h"
#endif

namespace pds
{

namespace
{

bool is_held(const std::string& extension, const PointTable& points, const std::string& name)
{
  const auto is_one_of = [&name](std::initializer_list<const char*> names) {
    return std::find(names.begin(), names.end(), name) != names.end();
  };
  const bool holds_positions_only = extension == ".stl";
  const bool holds_attributes = extension != ".stl" && extension != ".obj";
  return holds_attributes || is_one_of({"x", "y", "z"}) ||
         (!holds_positions_only && points.has_normals() && is_one_of({"nx", "ny", "nz"})) ||
         (!holds_positions_only && points.has_byte_colors() && is_one_of({"red", "green", "blue"}));
}

}  // namespace

std::vector<std::string> mesh_extensions()
{
#ifdef PCL_PDS_RECON_WITH_VTK
  return {".ply", ".obj", ".stl", ".vtk", ".vtp"};
#else
  return {".ply", ".obj", ".stl"};
#endif
}

std::string lost_in_format(const std::string& extension, const PointTable& points, bool ascii)
{
  std::string lost;
  for (const Field& field : points.fields()) {
    if (!is_held(extension, points, field.name)) {
      lost += (lost.empty() ? "the fields " : " ") + field.name;
    }
  }
  const bool rounds_all = extension == ".vtk" && ascii;
  if (rounds_all || (extension == ".stl" && points.has_double_positions())) {
    lost += std::string(lost.empty() ? "" : " and ") + "the last digits of the coordinates";
  }
  return lost;
}

void write_mesh(
    AtomicFile& file, const std::string& extension, const PointTable& points, const Triangles& triangles, bool ascii)
{
  if (extension == ".ply") {
    write_ply(file, points, triangles, ascii);
  } else if (extension == ".obj") {
    write_obj(file, points, triangles);
  } else if (extension == ".stl") {
    write_stl(file, points, triangles, ascii);
  } else {
#ifdef PCL_PDS_RECON_WITH_VTK
    const std::string bytes = render_with_vtk(extension, points, triangles, ascii);
    file.write(bytes.data(), bytes.size());
#else
    throw OutputError("this build has no VTK and cannot write '" + extension + "'; write .ply");
#endif
  }
}

}  // namespace pds
