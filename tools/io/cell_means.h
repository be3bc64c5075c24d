// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <pcl_pds_recon/reconstruction.h>

namespace pds
{

/** \brief Puts vertices where the reconstruction has moved them, with means of their cells' attributes.
 *
 * Fractional fields, colours and intensity become means over the points of the vertex's cell that have a value; normals
 * are unit vectors again. Other whole numbers, such as classes, are no quantities: the vertex keeps its seed's.
 * \param vertices rows of \a points, one for each vertex
 */
void apply_moves(PointTable& vertices, const PointTable& points, const MovedVertices& moved, const Parallel& parallel);

}  // namespace pds
