// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstring>

namespace pds
{

/** \brief The number whose bytes lie at \a place, aligned or not, in the byte order of this machine. */
template <typename Number>
[[nodiscard]] Number number_at(const void* place)
{
  Number number;
  std::memcpy(&number, place, sizeof number);
  return number;
}

}  // namespace pds
