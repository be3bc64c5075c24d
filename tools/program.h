// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <functional>
#include <stdexcept>
#include <string>

namespace pds
{

/** \brief Thrown for bad usage; what() is one line that names the option and what it takes. */
struct UsageError : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** \brief Carries a program out; what goes wrong is said in one line on standard error, after the program's name.
 * \param body returns the exit status
 * \return the exit status: that of \a body, 1 for bad data, 2 for bad usage
 */
[[nodiscard]] int run_program(const std::string& name, const std::function<int()>& body);

}  // namespace pds
