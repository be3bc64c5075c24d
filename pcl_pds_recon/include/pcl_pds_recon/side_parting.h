// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/triangle_complex.h>
#include <Eigen/Core>
#include <cstddef>
#include <vector>

namespace pds
{

/** \brief Parts a surface one piece of which shows its outside and another its inside: where nothing is known of sides,
 * as on walls seen from above, they may have been joined wrongly. Faces are put together again edge by edge, flat edges
 * first, unless that would join a piece of one side to one of the other; so the parting runs along the sharpest edges
 * between them, and a row of faces is taken out there. O(m log m).
 * \param complex after clean_mesh()
 * \param outward by vertex: the direction that leads outside, 0 if unknown; empty if all are
 * \return the number of faces taken out */
std::size_t part_sides(TriangleComplex& complex, const std::vector<Eigen::Vector3d>& outward);

}  // namespace pds
