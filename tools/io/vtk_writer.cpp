// SPDX-License-Identifier: BSD-3-Clause
#include "io/vtk_writer.h"

#include "io/plugin.h"

namespace pds
{

std::string render_with_vtk(const std::string& extension,
                            const PointTable& points,
                            const Triangles& triangles,
                            const Segments& segments,
                            bool ascii)
{
  std::string bytes;
  std::string complaint;
  try {
    void* function = load_plugin_function("pcl_pds_recon_vtk", "pcl_pds_recon_render_with_vtk");
    reinterpret_cast<decltype(&pcl_pds_recon_render_with_vtk)>(function)(extension, points, triangles, segments, ascii,
                                                                         bytes, complaint);
  } catch (const PluginError& error) {
    complaint = "'" + extension + "' cannot be written: " + error.what() + ", or write .ply, which does without";
  }
  if (!complaint.empty()) {
    throw OutputError(complaint);
  }
  return bytes;
}

}  // namespace pds
