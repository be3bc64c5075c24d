// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/hole_filling.h>
#include <pcl_pds_recon/seed_graph.h>
#include <cstddef>

namespace pds
{

/** \brief Mends a mesh of noisy points without normals by the sides that the mesh itself shows: most faces at a seed
 * tell which way out of the plane of its cell is outside. Faces that turn to the other side, or have a corner over 120
 * degrees off its own, are taken out, and the holes are filled as if the cloud had these normals. Where that cannot be
 * done the faces come back. O(m), and what filling costs.
 * \param complex after fill_gaps() with the same limits
 * \return the number of faces that were against the sides shown */
std::size_t mend_sides(TriangleComplex& complex,
                       const SeedGeometry& seeds,
                       const BorderingCells& bordering,
                       const FillLimits& limits);

}  // namespace pds
