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

/** \brief The inputs as messages name them: the first one and how many more there are. */
[[nodiscard]] std::string input_name(const CommandLine& command_line);

}  // namespace pds
