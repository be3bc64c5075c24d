// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line.h"

namespace pds
{

/** \brief Checks that the options go together. \throws UsageError */
void check_combination(const CommandLine& command_line);

/** \brief Checks that the outputs have names that can be written, and that no file is named twice. \throws UsageError
 */
void check_files(const CommandLine& command_line);

}  // namespace pds
