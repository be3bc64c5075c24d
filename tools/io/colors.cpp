// SPDX-License-Identifier: BSD-3-Clause
#include "io/colors.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pds
{

double full_brightness(ScalarType type)
{
  return visit_scalar(type, [](auto zero) {
    using Limits = std::numeric_limits<decltype(zero)>;
    return Limits::is_integer ? static_cast<double>(Limits::max()) : 1.0;
  });
}

Colors::Colors(const PointTable& points) : points_(points)
{
  std::transform(color_fields.begin(), color_fields.end(), fields_.begin(),
                 [&points](const char* name) { return points.find(name); });
  full_brightness_ = full_brightness(fields_.front()->type);
}

std::array<double, 3> Colors::operator[](std::size_t row) const
{
  std::array<double, 3> color{};
  std::transform(fields_.begin(), fields_.end(), color.begin(), [this, row](const Field* field) {
    const double value = points_.value(row, *field);
    return std::isnan(value) ? 0 : value / full_brightness_;
  });
  return color;
}

std::vector<ByteColor> byte_colors(const PointTable& points)
{
  if (!points.color_type()) {
    return {};
  }
  const Colors colors(points);
  std::vector<ByteColor> bytes(points.size());
  for (std::size_t row = 0; row < points.size(); ++row) {
    const std::array<double, 3> color = colors[row];
    std::transform(color.begin(), color.end(), bytes[row].begin(), [](double channel) {
      return static_cast<std::uint8_t>(std::lround(channel * std::numeric_limits<std::uint8_t>::max()));
    });
  }
  return bytes;
}

}  // namespace pds
