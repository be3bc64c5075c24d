// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/triangle_mesh.h>

namespace pds
{

/** \brief A point of a mesh. */
struct SurfaceSample
{
  Eigen::Vector3d point;
  std::uint32_t face;
};

/** \brief Samples of a mesh, evenly by area and in the order of its faces: all faces are laid end to end by their
 * areas, this line is cut into \a count equal pieces, and one place drawn in each. How far along its face it lies fixes
 * the sample in one direction, multiples of the golden ratio in the other. O(faces + count).
 * \param mesh must have an area
 */
[[nodiscard]] std::vector<SurfaceSample> sample_surface(const TriangleMesh& mesh,
                                                        std::size_t count,
                                                        std::uint64_t seed,
                                                        const Parallel& parallel);

}  // namespace pds
