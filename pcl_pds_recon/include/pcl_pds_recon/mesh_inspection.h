// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <optional>

#include <pcl_pds_recon/triangle_mesh.h>

namespace pds
{

/** \brief What can be wrong with a triangle mesh, counted. Names are those of Report.
 *
 * Faces that name a vertex twice are counted as degenerate and otherwise left out; all others take part.
 */
struct MeshInspection
{
  std::size_t vertices = 0;              ///< that have a face
  std::size_t faces = 0;                 ///< triangles
  std::size_t edges = 0;                 ///< of at least one face
  std::size_t components = 0;            ///< connected by edges
  std::size_t boundary_edges = 0;        ///< of one face
  std::size_t boundary_loops = 0;        ///< of boundary edges
  std::size_t nonmanifold_edges = 0;     ///< more than two faces
  std::size_t nonmanifold_vertices = 0;  ///< faces that are not a single fan
  std::size_t inconsistent_edges = 0;    ///< both faces run along it in the same direction
  long long euler = 0;                   ///< vertices - edges + faces
  bool closed = false;                   ///< there are faces and no boundary
  bool orientable = true;                ///< faces could be turned so that no edge with two faces is inconsistent
  /** Sum over the components, their boundary loops closed by disks and fans that meet in a vertex pulled apart. Only if
   * the mesh is orientable and has no non-manifold edge. */
  std::optional<long long> genus;
  std::size_t duplicate_faces = 0;        ///< with the vertices of an earlier face, in any order
  std::size_t degenerate_faces = 0;       ///< that name a vertex twice, or are flat to within flat_height
  std::size_t unreferenced_vertices = 0;  ///< without a face
};

/** \brief A face is flat if its height is below this share of its longest edge: no direction is left in it even in
 * double precision. */
constexpr double flat_height = 1e-12;

/** \brief Inspects any mesh. O(faces log faces).
 * \throws InvalidInput if a face names a vertex that is not there or is not finite
 */
[[nodiscard]] MeshInspection inspect_mesh(const TriangleMesh& mesh);

}  // namespace pds
