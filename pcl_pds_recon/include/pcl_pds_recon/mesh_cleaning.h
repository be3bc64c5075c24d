// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/seed_graph.h>
#include <pcl_pds_recon/triangle_complex.h>

namespace pds
{

/** \brief True if a component of so many faces is too small to be kept beside one of so many as \a largest has. */
[[nodiscard]] bool is_speck(std::size_t faces, std::size_t largest);

/** \brief Removes what cannot stay: all but the largest fan at pinched vertices, and small components that are
 * no surface (specks of a few faces, scatter left by points that fill a volume). Afterwards every vertex has one fan.
 */
void clean_mesh(TriangleComplex& complex, const SeedGeometry& seeds);

/** \brief Likewise after a clean mesh was cut: what is left of scatter hung together with a surface, and stays. */
void clean_cuts(TriangleComplex& complex);

}  // namespace pds
