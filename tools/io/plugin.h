// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <stdexcept>
#include <string>

namespace pds
{

/** \brief Thrown if a part of the program that is loaded on demand is not there; what() says what to install. */
struct PluginError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** \brief Loads the shared library \a name and returns the address of its function \a function.
 *
 * Large libraries such as VTK and PDAL are linked to plugins, so that a run that does not need them does not wait until
 * the system has loaded them, which takes longer than reading a million points. The library is looked for where the
 * program's own run path says, and stays loaded.
 * \throws PluginError
 */
[[nodiscard]] void* load_plugin_function(const std::string& name, const std::string& function);

}  // namespace pds
