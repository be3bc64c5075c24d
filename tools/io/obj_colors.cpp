// SPDX-License-Identifier: BSD-3-Clause
#include "io/obj_colors.h"

#include "io/colors.h"
#include "io/text_scanner.h"

#include <algorithm>
#include <cmath>

namespace pds
{

namespace
{

/** What one more in the last digit of a number adds to it: 0.01 for 0.25. */
double unit_of_last_digit(std::string_view word)
{
  const std::size_t exponent_at = word.find_first_of("eE");
  int exponent = 0;
  if (exponent_at != std::string_view::npos && !parse_number(word.substr(exponent_at + 1), exponent)) {
    return 0;
  }
  const std::string_view digits = word.substr(0, exponent_at);
  const std::size_t point = digits.find('.');
  const auto decimals = point == std::string_view::npos ? 0 : static_cast<int>(digits.size() - point) - 1;
  return std::pow(10.0, exponent - decimals);
}

// With fewer digits every number could have been a whole one: 0.5 is less than 0.1 from 128 / 255.
constexpr double coarsest_unit_of_byte = 1e-3;
constexpr double coarsest_unit_of_word = 1e-6;

/** Whether a colour may have been a whole number of this type before it was written with so many digits. */
bool fits(double channel, double unit, ScalarType type, double coarsest_unit)
{
  constexpr double rounding = 1e-10;  // of a double in 0 ... 65535
  const double value = channel * full_brightness(type);
  return std::abs(value - std::round(value)) <= std::min(unit, coarsest_unit) * full_brightness(type) + rounding;
}

}  // namespace

bool ObjColors::add(const std::string_view* first)
{
  Vector& color = values_.emplace_back();
  for (std::size_t i = 0; i < color.size(); ++i) {
    if (!parse_number(first[i], color[i])) {
      return false;
    }
    are_in_range_ = are_in_range_ && color[i] >= 0 && color[i] <= 1;
    const double unit = unit_of_last_digit(first[i]);
    fits_byte_ = fits_byte_ && fits(color[i], unit, ScalarType::uint8, coarsest_unit_of_byte);
    fits_word_ = fits_word_ && fits(color[i], unit, ScalarType::uint16, coarsest_unit_of_word);
  }
  return true;
}

ScalarType ObjColors::type() const
{
  if (fits_byte_) {
    return ScalarType::uint8;
  }
  return fits_word_ ? ScalarType::uint16 : ScalarType::float64;
}

std::vector<ObjColors::Vector> ObjColors::of_vertices(std::size_t count) const
{
  if (values_.size() != count || !are_in_range_) {
    return {};
  }
  std::vector<Vector> colors = values_;
  if (type() != ScalarType::float64) {
    for (Vector& color : colors) {
      for (double& channel : color) {
        channel = std::round(channel * full_brightness(type()));
      }
    }
  }
  return colors;
}

}  // namespace pds
