// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <optional>
#include <string>

namespace pds
{

/** \brief Reads a LAZ, COPC or E57 file with the plugin that links PDAL.
 *
 * All dimensions, under PDAL's names in snake case and those of read_las; NormalX is nx. Colours become bytes if that
 * loses nothing.
 * \throws InvalidInput if PDAL cannot read the file or the plugin is not installed
 */
[[nodiscard]] PointTable read_with_pdal(const std::string& path);

/** \brief The plugin's function. What goes wrong is left in \a complaint, since no exception may leave a plugin. */
extern "C" void pcl_pds_recon_read_with_pdal(const std::string& path,
                                             std::optional<PointTable>& table,
                                             std::string& complaint);

}  // namespace pds
