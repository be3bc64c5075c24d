// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/deviation.h>
#include <pcl_pds_recon/parallel.h>

#include "compare/surface_tree.h"
#include "compare/triangle_intersection.h"

namespace pds
{

std::size_t count_self_intersections(const TriangleMesh& mesh, unsigned threads)
{
  validate(mesh);
  if (mesh.faces.empty()) return 0;
  const SurfaceTree tree(mesh, Parallel(threads).threads());
  const auto corners = [&mesh](std::uint32_t f) -> TriangleCorners {
    const Triangle& face = mesh.faces[f];
    return {mesh.vertices[face[0]], mesh.vertices[face[1]], mesh.vertices[face[2]]};
  };
  return tree.count_pairs(
      [&](std::uint32_t f, std::uint32_t g) { return triangles_intersect(corners(f), corners(g)); });
}

}  // namespace pds
