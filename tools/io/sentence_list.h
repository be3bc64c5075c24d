// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pds
{

/** \brief "a, b and c", as a part of a sentence. */
[[nodiscard]] inline std::string sentence_list(const std::vector<std::string>& items)
{
  std::string text;
  for (std::size_t i = 0; i < items.size(); ++i) {
    const char* separator = i + 1 < items.size() ? ", " : " and ";
    text += (i == 0 ? "" : separator) + items[i];
  }
  return text;
}

}  // namespace pds
