// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pds
{

/** \brief What the keys of the window do, a line for each. */
[[nodiscard]] std::string key_help();

}  // namespace pds
