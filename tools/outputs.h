// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line.h"
#include "io/point_table.h"

#include <pcl_pds_recon/reconstruction.h>

#include <functional>
#include <string>
#include <vector>

namespace pds
{

/** \brief Checks before the work that every file to be written can be. \throws OutputError */
void check_outputs(const CommandLine& command_line);

/** \brief Writes the configuration file of --save-config. \throws OutputError */
void save_config(const CommandLine& command_line);

/** \brief Writes the meshes and, if asked for, the first one's Voronoi cells, report and page: either all appear or
 * none.
 * \param complete_report called when the meshes are written, to enter what is known only then
 * \return what the mesh's format cannot hold and what the page lacks, each as a sentence
 * \throws OutputError
 */
[[nodiscard]] std::vector<std::string> save_outputs(const CommandLine& command_line,
                                                    const PointTable& points,
                                                    std::vector<Reconstruction>& levels,
                                                    const std::function<void(Report&)>& complete_report);

}  // namespace pds
