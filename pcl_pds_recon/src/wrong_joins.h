// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <pcl_pds_recon/triangle_complex.h>

namespace pds
{

/** \brief Finds what joins the sides of a thin part the wrong way round, after which the triangles along its rims are
 * refused, for they would make the surface one-sided.
 *
 * Flat pieces of the surface are put together again, those first for which the clearest majority of edges and of
 * refused triangles tells which way round. O(m log m) for m edges.
 * \param refused triangles that would make the complex one-sided
 * \return faces at the edges that the majority is against, ascending */
std::vector<std::uint32_t> wrong_joins(const TriangleComplex& complex, const std::vector<Triangle>& refused);

}  // namespace pds
