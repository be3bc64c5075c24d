// SPDX-License-Identifier: BSD-3-Clause
#include "io/las_bounds.h"

#include <pcl_pds_recon/options.h>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace pds
{

namespace
{

/** The least and the greatest of some numbers. */
struct Range
{
  double least = std::numeric_limits<double>::infinity();
  double greatest = -std::numeric_limits<double>::infinity();

  [[nodiscard]] double width() const { return greatest - least; }
  void add(double value)
  {
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  Range& operator+=(const Range& other)
  {
    add(other.least);
    add(other.greatest);
    return *this;
  }
};

/** What the header says about one coordinate. */
struct Axis
{
  double scale;
  double offset;
  Range bounds;
};

constexpr double steps_of_rounding = 2;

Range range_of(const PointTable& points, const Field& field, const Parallel& parallel)
{
  constexpr std::size_t block = std::size_t{1} << 15;  // points; some hundred microseconds
  return parallel.sum(points.size(), block, [&](std::size_t begin, std::size_t end) {
    Range range;
    for (std::size_t i = begin; i < end; ++i) {
      range.add(points.value(i, field));
    }
    return range;
  });
}

double tolerance_of(const Axis& axis)
{
  constexpr double float_rounding = std::numeric_limits<float>::epsilon() / 2;
  constexpr double digits_of_text = 1e-4;  // of the width
  const double magnitude = std::max(std::abs(axis.bounds.least), std::abs(axis.bounds.greatest));
  return steps_of_rounding * axis.scale + float_rounding * magnitude + digits_of_text * axis.bounds.width();
}

[[noreturn]] void throw_outside(const PointTable& points, const Field& field, const Range& allowed, const Axis& axis)
{
  std::size_t i = 0;
  while (points.value(i, field) >= allowed.least && points.value(i, field) <= allowed.greatest) {
    ++i;
  }
  throw InvalidInput(fmt::format(
      "has points outside the bounds in its LAS header ({} from {} to {}, point {} at {}): the scale, offset "
      "or bounds there are wrong; copy it again or write it anew",
      field.name, axis.bounds.least, axis.bounds.greatest, i + 1, points.value(i, field)));
}

/** Whether a scale is one that people choose: 1, 2, 2.5 or 5 times a power of ten, within a relative \a error. */
bool is_round(double scale, double error)
{
  const double decade = std::pow(10, std::floor(std::log10(scale) + error));
  constexpr std::array<double, 5> leading = {1, 2, 2.5, 5, 10};
  return std::any_of(leading.begin(), leading.end(),
                     [&](double number) { return std::abs(scale / decade - number) <= error * number; });
}

/** Whether the integers of the file would fill its bounds with the same offset and another scale. */
bool is_of_other_scale(const Axis& axis, const Range& found)
{
  constexpr double least_steps = 1000;  // below that most scales are round within the rounding of the bounds
  const double steps = found.width() / axis.scale;
  const double ratio = axis.bounds.width() / found.width();
  const double error = 2 * steps_of_rounding / steps;  // at either end
  const double offset = axis.bounds.least - ratio * (found.least - axis.offset);
  return steps >= least_steps && std::abs(ratio - 1) > error && is_round(axis.scale * ratio, error) &&
         std::abs(offset - axis.offset) <= steps_of_rounding * axis.scale * ratio;
}

void check_axis(const PointTable& points, const Field& field, const Axis& axis, const Parallel& parallel)
{
  const bool is_filled_in = axis.bounds.least != 0 || axis.bounds.greatest != 0;
  if (!is_filled_in) {
    return;
  }
  const double tolerance = tolerance_of(axis);
  const Range allowed = {axis.bounds.least - tolerance, axis.bounds.greatest + tolerance};
  const Range found = range_of(points, field, parallel);
  if (!(found.least >= allowed.least && found.greatest <= allowed.greatest)) {  // nor NaN
    throw_outside(points, field, allowed, axis);
  }
  if (is_of_other_scale(axis, found)) {
    throw InvalidInput(fmt::format(
        "has bounds in its LAS header that are those of another scale than {} of {}: it is damaged; copy it again",
        axis.scale, field.name));
  }
}

}  // namespace

void check_las_bounds(const LasHeader& header, const PointTable& points, const Parallel& parallel)
{
  if (points.size() == 0) {
    return;
  }
  for (std::size_t i = 0; i < position_fields.size(); ++i) {
    const Axis axis = {header.scale[i], header.offset[i], {header.least[i], header.greatest[i]}};
    check_axis(points, *points.find(position_fields.at(i)), axis, parallel);
  }
}

}  // namespace pds
