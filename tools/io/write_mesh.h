// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/ply_writer.h"

#include <string>
#include <vector>

namespace pds
{

/** \brief The extensions that write_mesh takes in this build; .vtk and .vtp need VTK. */
[[nodiscard]] std::vector<std::string> mesh_extensions();

/** \brief What the format of \a extension cannot hold of these points, as the end of a sentence; empty if nothing. */
[[nodiscard]] std::string lost_in_format(const std::string& extension, const PointTable& points, bool ascii);

/** \brief True if the format of \a extension has edges that belong to no face. */
[[nodiscard]] bool holds_segments(const std::string& extension);

/** \brief Writes a mesh in the format of \a extension, one of mesh_extensions().
 * \param ascii text instead of binary where the format has both
 * \param segments edges of curves, if the format holds them
 * \throws OutputError if the file cannot be written
 */
void write_mesh(AtomicFile& file,
                const std::string& extension,
                const PointTable& points,
                const Triangles& triangles,
                bool ascii,
                const Segments& segments = {});

}  // namespace pds
