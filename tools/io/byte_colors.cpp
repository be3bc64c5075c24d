// SPDX-License-Identifier: BSD-3-Clause
#include "io/byte_colors.h"

namespace pds
{

std::vector<ByteColor> byte_colors(const PointTable& points)
{
  const std::optional<ScalarType> type = points.color_type();
  if (!type) {
    return {};
  }
  const double divisor = *type == ScalarType::uint16 ? 257 : 1;  // 65535 becomes 255
  std::vector<ByteColor> colors(points.size());
  std::size_t channel = 0;
  for (const char* name : {"red", "green", "blue"}) {
    const Field& field = *points.find(name);
    for (std::size_t row = 0; row < points.size(); ++row) {
      colors[row][channel] = static_cast<std::uint8_t>(points.value(row, field) / divisor);
    }
    ++channel;
  }
  return colors;
}

}  // namespace pds
