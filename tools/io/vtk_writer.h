// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/ply_writer.h"

#include <string>

namespace pds
{

/** \brief The bytes of a mesh, and of the edges of curves, as .vtk or .vtp, made by the plugin that links VTK.
 *
 * Every field is a named array of the points; colours are RGB, normals Normals.
 * \throws OutputError if VTK cannot make them or the plugin is not installed
 */
[[nodiscard]] std::string render_with_vtk(const std::string& extension,
                                          const PointTable& points,
                                          const Triangles& triangles,
                                          const Segments& segments,
                                          bool ascii);

/** \brief The plugin's function. What goes wrong is left in \a complaint, since no exception may leave a plugin. */
extern "C" void pcl_pds_recon_render_with_vtk(const std::string& extension,
                                              const PointTable& points,
                                              const Triangles& triangles,
                                              const Segments& segments,
                                              bool ascii,
                                              std::string& bytes,
                                              std::string& complaint);

}  // namespace pds
