// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>

namespace pds
{

/** \brief A text in one line, with control characters, and bytes that are no UTF-8, as \\n or \\x1b: whatever names and
 * files hold, a terminal shall show it and not obey it. */
[[nodiscard]] std::string printable(const std::string& text);

}  // namespace pds
