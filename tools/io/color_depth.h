// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <array>
#include <cstdint>

namespace pds
{

/** \brief Finds out whether 16-bit colours hold 8 bits each, which writers spread by 257, by 256, or not at all. */
class ColorDepth
{
 public:
  /** \brief Takes the value of one channel into account. */
  void add(std::uint16_t channel)
  {
    for (std::size_t i = 0; i < factors.size(); ++i) {
      fits_[i] = fits_[i] && channel % factors[i] == 0 && channel / factors[i] <= greatest_byte;
    }
  }

  /** \brief Takes all that \a other has seen into account. */
  void add(const ColorDepth& other)
  {
    for (std::size_t i = 0; i < factors.size(); ++i) {
      fits_[i] = fits_[i] && other.fits_[i];
    }
  }

  /** \brief What all channels can be divided by to become bytes; 0 if nothing. */
  [[nodiscard]] std::uint16_t divisor() const
  {
    for (std::size_t i = 0; i < factors.size(); ++i) {
      if (fits_[i]) {
        return factors[i];
      }
    }
    return 0;
  }

 private:
  static constexpr std::array<std::uint16_t, 3> factors = {1, 257, 256};
  static constexpr unsigned greatest_byte = 255;

  std::array<bool, 3> fits_ = {true, true, true};
};

/** \brief The same points with red, green and blue as bytes if they are 16-bit colours and that loses nothing. */
[[nodiscard]] PointTable with_byte_colors(PointTable points);

}  // namespace pds
