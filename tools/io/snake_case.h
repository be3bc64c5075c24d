// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cctype>
#include <string>
#include <string_view>

namespace pds
{

/** \brief The name of a field as this project spells it: "PointSourceId" and "Point source id" are point_source_id. */
[[nodiscard]] inline std::string snake_case(std::string_view name)
{
  std::string snake;
  for (const char letter : name) {
    const auto code = static_cast<unsigned char>(letter);
    if (std::isupper(code) != 0 && !snake.empty() && snake.back() != '_') {
      snake += '_';
    }
    snake += std::isgraph(code) != 0 ? static_cast<char>(std::tolower(code)) : '_';
  }
  return snake;
}

}  // namespace pds
