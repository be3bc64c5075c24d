// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/hole_filling.h>

namespace pds
{

/** \brief Removes handles and tunnels that are too small to be told from noise: those with a loop of six edges or fewer
 * around them, or through them. Surfaces of noisy points often touch themselves at thin parts.
 *
 * Every handle has a loop that does not divide the surface. The shortest ones are found by a tree of edges and a tree
 * of faces across the others: each edge that is in neither closes such a loop (Erickson and Whittlesey, Greedy optimal
 * homotopy and homology generators, SODA 2005). The faces along a short one are taken out and the holes that leaves
 * filled, one at each end of the handle; if they cannot be, it stays. O(m log m) for each handle.
 * \param complex without pinched vertices
 * \return the number of handles removed
 */
std::size_t remove_small_handles(TriangleComplex& complex, const BorderingCells& bordering, const FillLimits& limits);

}  // namespace pds
