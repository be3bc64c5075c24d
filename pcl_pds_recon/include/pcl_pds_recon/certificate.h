// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/triangle_complex.h>

namespace pds
{

/** \brief Topology of a triangle mesh, counted from its faces alone, whoever made them. */
struct Certificate
{
  std::size_t vertices = 0;                                ///< that have a face
  std::size_t faces = 0;                                   ///< triangles
  std::size_t edges = 0;                                   ///< of at least one face
  std::size_t components = 0;                              ///< connected by edges
  std::size_t nonmanifold_edges = 0;                       ///< more than two faces
  std::size_t nonmanifold_vertices = 0;                    ///< faces that are not a single fan
  std::size_t inconsistent_edges = 0;                      ///< both faces run along it in the same direction
  long long euler = 0;                                     ///< vertices - edges + faces
  std::vector<std::vector<std::uint32_t>> boundary_loops;  ///< in the direction of the faces
};

/** \brief Certifies a mesh. O(faces).
 * \param triangles with three different vertices each, below \a vertex_count
 */
[[nodiscard]] Certificate certify(const std::vector<Triangle>& triangles,
                                  std::size_t vertex_count,
                                  const Parallel& parallel = Parallel(1));

}  // namespace pds
