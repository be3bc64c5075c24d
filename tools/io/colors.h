// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"

#include <array>
#include <cstdint>
#include <vector>

namespace pds
{

/** \brief What a channel of full brightness has in fields of one of the types of PointTable::color_type(). */
[[nodiscard]] double full_brightness(ScalarType type);

/** \brief The colours of points that have a color_type(), whatever it is. */
class Colors
{
 public:
  /** \brief Valid as long as \a points is neither changed nor destroyed. */
  explicit Colors(const PointTable& points);

  /** \brief Red, green and blue in 0 ... 1; black where a point has none. */
  [[nodiscard]] std::array<double, 3> operator[](std::size_t row) const;

 private:
  const PointTable& points_;
  std::array<const Field*, 3> fields_{};
  double full_brightness_;
};

using ByteColor = std::array<std::uint8_t, 3>;  ///< red, green, blue

/** \brief The colours of the points as a screen shows them; empty if they have none. */
[[nodiscard]] std::vector<ByteColor> byte_colors(const PointTable& points);

}  // namespace pds
