// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line.h"
#include "io/point_table.h"

#include <string>
#include <vector>

namespace pds
{

/** \brief The points that the command line asks for: all inputs, of the wanted classes, merged if there are several.
 * \param warnings sentences about what the inputs hold and the cloud does not
 * \throws InvalidInput naming the input that is at fault
 */
[[nodiscard]] PointTable load_points(const CommandLine& command_line, std::vector<std::string>& warnings);

/** \brief Of the points of a file those that the command line asks for.
 * \param warnings likewise
 * \throws InvalidInput naming the file
 */
[[nodiscard]] PointTable select_points(const std::string& path,
                                       PointTable points,
                                       const CommandLine& command_line,
                                       std::vector<std::string>& warnings);

/** \brief The points of all files, merged if there are several. \param warnings likewise */
[[nodiscard]] PointTable merge_clouds(const std::vector<std::string>& paths,
                                      std::vector<PointTable> clouds,
                                      const CommandLine& command_line,
                                      std::vector<std::string>& warnings);

/** \brief The inputs as messages name them: the first one and how many more there are. */
[[nodiscard]] std::string input_name(const CommandLine& command_line);

}  // namespace pds
