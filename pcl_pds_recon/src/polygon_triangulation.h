// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include <pcl_pds_recon/hole_filling.h>

namespace pds
{

/** \brief Of all triangulations of a polygon in space whose chords are new, within the limits and, if asked for,
 * between bordering cells, and that fold nowhere, the one with the least sum of squared circumradii. O(n^3) for n
 * corners. \param bordering null if any chord will do \return empty if there is none
 */
[[nodiscard]] std::vector<Triangle> triangulate(const TriangleComplex& complex,
                                                const BorderingCells* bordering,
                                                const Polygon& polygon,
                                                const FillLimits& limits);

/** \brief Distance of two vertices in the lengths that the limits are in. */
[[nodiscard]] double local_length(const TriangleComplex& complex,
                                  std::uint32_t a,
                                  std::uint32_t b,
                                  const FillLimits& limits);

/** \brief Length of the polygon's sides, likewise. */
[[nodiscard]] double perimeter(const TriangleComplex& complex, const Polygon& polygon, const FillLimits& limits);

/** \brief Area of all triangles together. */
[[nodiscard]] double area_of(const std::vector<Triangle>& triangles, const std::vector<Eigen::Vector3d>& position);

}  // namespace pds
