// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/ply_writer.h"

namespace pds
{

/** \brief The vertices with the normals of the mesh as fields nx ny nz, in place of any of the same name.
 *
 * A vertex's normal is the mean of its faces' normals, each weighted by the face's angle there, which does not depend
 * on how a flat polygon is cut into triangles (Thürmer and Wüthrich 1998).
 */
[[nodiscard]] PointTable with_vertex_normals(const PointTable& vertices, const Triangles& triangles);

}  // namespace pds
