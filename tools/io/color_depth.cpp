// SPDX-License-Identifier: BSD-3-Clause
#include "io/color_depth.h"

namespace pds
{

PointTable with_byte_colors(PointTable points)
{
  if (points.color_type() != ScalarType::uint16) {
    return points;
  }
  ColorDepth depth;
  for (const char* name : color_fields) {
    for (std::size_t row = 0; row < points.size(); ++row) {
      depth.add(static_cast<std::uint16_t>(points.value(row, *points.find(name))));
    }
  }
  if (depth.divisor() == 0) {
    return points;
  }
  PointTable table = points.with_fields(
      {{"red", ScalarType::uint8}, {"green", ScalarType::uint8}, {"blue", ScalarType::uint8}}, Parallel(1));
  for (const char* name : color_fields) {
    for (std::size_t row = 0; row < points.size(); ++row) {
      table.set_value(row, *table.find(name), points.value(row, *points.find(name)) / depth.divisor());
    }
  }
  return table;
}

}  // namespace pds
