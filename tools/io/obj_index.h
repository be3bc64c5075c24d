// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/text_scanner.h"

#include <pcl_pds_recon/options.h>

#include <cstdint>
#include <limits>
#include <string>

namespace pds
{

/** \brief The number of a vertex or a normal in a line of an OBJ file: "7" is the 7th, "-1" the one read last.
 * \param so_far how many have been read
 * \return its number from 0, which may be one that the file does not have
 * \throws InvalidInput naming the line if it is no number or counts back to before the first
 */
[[nodiscard]] inline std::uint32_t parse_obj_index(std::string_view word, std::size_t so_far, std::size_t line_number)
{
  std::int64_t number = 0;
  if (!parse_number(word, number) || number == 0) {
    throw InvalidInput("line " + std::to_string(line_number) + " is not 'f' and numbers of vertices; correct it");
  }
  const std::int64_t index = number > 0 ? number - 1 : static_cast<std::int64_t>(so_far) + number;
  if (index < 0 || index >= std::numeric_limits<std::uint32_t>::max()) {
    throw InvalidInput("line " + std::to_string(line_number) + " names a vertex that is not there; correct it");
  }
  return static_cast<std::uint32_t>(index);
}

}  // namespace pds
