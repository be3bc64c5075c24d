// SPDX-License-Identifier: BSD-3-Clause
#include "io/pdal_reader.h"

#include "io/color_depth.h"
#include "io/plugin.h"

#include <pcl_pds_recon/options.h>

#include <utility>

namespace pds
{

PointTable read_with_pdal(const std::string& path)
{
  std::optional<PointTable> table;
  std::string complaint;
  try {
    void* function = load_plugin_function("pcl_pds_recon_pdal", "pcl_pds_recon_read_with_pdal");
    reinterpret_cast<decltype(&pcl_pds_recon_read_with_pdal)>(function)(path, table, complaint);
  } catch (const PluginError& error) {
    complaint = std::string("cannot be read: ") + error.what() + ", or convert the file to .las or .ply";
  }
  if (!complaint.empty()) {
    throw InvalidInput(complaint);
  }
  return with_byte_colors(std::move(*table));
}

}  // namespace pds
