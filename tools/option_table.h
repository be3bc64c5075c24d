// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "command_line.h"

#include <functional>
#include <string>
#include <vector>

namespace pds
{

/** \brief An option of the command line: how it is spelled, explained, read and written. */
struct OptionRow
{
  std::string name;      ///< long name, without dashes
  char letter;           ///< short name, 0 if none
  std::string argument;  ///< what the help calls the argument; empty for a switch
  std::string help;
  /** \brief Stores the argument, or "true" and "false" for a switch. \return false if it is not one of its kind */
  std::function<bool(CommandLine&, const std::string&)> set;
  /** \brief The argument that would store the present value; unset for options with no place in a configuration file.
   */
  std::function<std::string(const CommandLine&)> get;

  [[nodiscard]] bool is_switch() const { return argument.empty(); }
};

/** \brief All options in the order of the help. */
[[nodiscard]] const std::vector<OptionRow>& option_table();

/** \brief The text of --help, which help2man makes a manual page of. */
[[nodiscard]] std::string help_text();

}  // namespace pds
