// SPDX-License-Identifier: BSD-3-Clause
#include "compare/mesh_file.h"

#include "compare/face_readers.h"
#include "io/byte_source.h"
#include "io/file_extension.h"
#include "io/read_points.h"

#include <pcl_pds_recon/options.h>

#ifdef PCL_PDS_RECON_WITH_VTK_READER
#include "compare/vtk_reader.h"
#endif

namespace pds
{

namespace
{

MeshFile read_by_extension(const std::string& path, const Parallel& parallel)
{
  const std::string extension = file_extension(path);
  if (extension == ".stl") {
    return read_stl(ByteSource::from_file(path).all());
  }
#ifdef PCL_PDS_RECON_WITH_VTK_READER
  if (extension == ".vtk" || extension == ".vtp") {
    static_cast<void>(ByteSource::from_file(path));  // says more than VTK if it cannot be read
    return read_with_vtk(path);
  }
#endif
  MeshFile mesh{read_points(path, parallel), {}};
  if (extension == ".ply") {
    mesh.triangles = read_ply_faces(ByteSource::from_file(path).all());
  } else if (extension == ".obj") {
    mesh.triangles = read_obj_faces(ByteSource::from_file(path).all());
  }
  return mesh;
}

/** read_points() has put the file's name into its own messages already. */
std::string with_path(const std::string& path, const std::string& message)
{
  return message.rfind(path + ": ", 0) == 0 ? message : path + ": " + message;
}

}  // namespace

void add_polygon(const std::vector<std::uint32_t>& corners, Triangles& triangles)
{
  if (corners.size() < 3) {
    throw InvalidInput("a face has only " + std::to_string(corners.size()) + " corners; remove it");
  }
  for (std::size_t i = 2; i < corners.size(); ++i) {
    triangles.push_back({corners[0], corners[i - 1], corners[i]});
  }
}

MeshFile read_mesh_file(const std::string& path, const Parallel& parallel)
{
  try {
    MeshFile mesh = read_by_extension(path, parallel);
    validate(to_mesh(mesh));
    return mesh;
  } catch (const InvalidInput& error) {
    throw InvalidInput(with_path(path, error.what()));
  }
}

std::vector<std::string> readable_extensions()
{
  return {".ply", ".obj", ".stl",
#ifdef PCL_PDS_RECON_WITH_VTK_READER
          ".vtk", ".vtp",
#endif
          ".pcd", ".las", ".xyz", ".txt", ".csv"};
}

TriangleMesh to_mesh(const MeshFile& file)
{
  TriangleMesh mesh;
  const PointCloudView view = file.points.view();
  mesh.vertices.reserve(view.size);
  for (std::size_t i = 0; i < view.size; ++i) {
    mesh.vertices.push_back(view.positions[i]);
    if (view.normals && file.triangles.empty()) {
      const Eigen::Vector3d normal = view.normals[i];
      mesh.normals.push_back(normal.allFinite() ? normal : Eigen::Vector3d(0, 0, 0));
    }
  }
  mesh.faces = file.triangles;
  return mesh;
}

}  // namespace pds
