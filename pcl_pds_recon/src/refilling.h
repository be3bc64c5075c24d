// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/hole_filling.h>

namespace pds
{

/** \brief Takes out the faces at these vertices, and at those that would be pinched then, and fills the holes at which
 * that leaves the surface.
 * \return false if one cannot be filled: the complex is of no use then, which is why it is to be a copy at first */
bool refill_around(TriangleComplex& complex,
                   const Polygon& vertices,
                   const BorderingCells& bordering,
                   const FillLimits& limits);

}  // namespace pds
