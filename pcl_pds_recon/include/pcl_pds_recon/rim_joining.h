// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include <pcl_pds_recon/hole_filling.h>
#include <pcl_pds_recon/seed_graph.h>
#include <pcl_pds_recon/triangle_complex.h>

namespace pds
{

/** \brief Joins rims that run along each other across a narrow gap, where the surface goes on from one to the other.
 *
 * A joint begins with two faces between two rim edges, where the gap is narrower than 2.5 radii with no seed between,
 * or where cells border across it; from there it goes on both ways like a zip. The first joint of two components may
 * end anywhere. Others must leave nothing open, or but a hole within the limit, at one end, and those of one
 * component's own rims at both: a bay of a large opening is no gap. No joint makes one surface of the outside of one
 * component and the inside of another, as far as they bulge; where both clearly do, it may run along a crease.
 * \param complex every vertex must have a single fan; that stays so
 * \return the number of joints */
std::size_t join_rims(TriangleComplex& complex,
                      const SeedGeometry& seeds,
                      const BorderingCells& bordering,
                      const FillLimits& limits);

}  // namespace pds
