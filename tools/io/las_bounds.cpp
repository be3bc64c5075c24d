// SPDX-License-Identifier: BSD-3-Clause
#include "io/las_bounds.h"

#include <pcl_pds_recon/options.h>

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

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
  double scale = 1;
  double offset = 0;
  Range bounds;

  /** Writers that do not know the bounds leave zeros, infinities, or the limits from which they would have narrowed. */
  [[nodiscard]] bool has_bounds() const
  {
    return std::isfinite(bounds.least) && std::isfinite(bounds.greatest) && bounds.least <= bounds.greatest &&
           (bounds.least != 0 || bounds.greatest != 0);
  }
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

void check_axis(const PointTable& points, const Field& field, const Axis& axis, const Range& found)
{
  const double tolerance = tolerance_of(axis);
  const Range allowed = {axis.bounds.least - tolerance, axis.bounds.greatest + tolerance};
  if (!(found.least >= allowed.least && found.greatest <= allowed.greatest)) {  // nor NaN
    throw_outside(points, field, allowed, axis);
  }
}

/** The power of ten by which the scale is to be multiplied so that the points fill the bounds to the last step, if
 * there is one. */
std::optional<int> missing_decades(const Axis& axis, const Range& found)
{
  constexpr double least_steps = 1000;  // points that take fewer may fit by chance
  const double width = axis.bounds.width();
  if (!std::isfinite(width) || !(width > 0) || found.width() < least_steps * axis.scale) {
    return std::nullopt;
  }
  const int decades = static_cast<int>(std::lround(std::log10(width / found.width())));
  const double factor = std::pow(10, decades);
  const double rounding = axis.scale * factor / 2;
  const auto is_at = [&](double coordinate, double bound) {
    return std::abs(factor * (coordinate - axis.offset) + axis.offset - bound) < rounding;
  };
  const bool fits = is_at(found.least, axis.bounds.least) && is_at(found.greatest, axis.bounds.greatest);
  return fits ? std::optional<int>(decades) : std::nullopt;
}

/** Whether other powers of ten as scales, with the same offsets, let the points fill all the bounds to the last step.
 */
bool are_of_other_scales(const std::array<Axis, 3>& axes, const std::array<Range, 3>& found)
{
  bool differ = false;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const std::optional<int> decades = missing_decades(axes[i], found[i]);
    if (!decades) {
      return false;
    }
    differ = differ || *decades != 0;
  }
  return differ;
}

}  // namespace

void check_las_bounds(const LasHeader& header, const PointTable& points, const Parallel& parallel)
{
  if (points.size() == 0) {
    return;
  }
  std::array<Axis, 3> axes;
  std::array<Range, 3> found;
  for (std::size_t i = 0; i < axes.size(); ++i) {
    const Field& field = *points.find(position_fields.at(i));
    axes[i] = {header.scale[i], header.offset[i], {header.least[i], header.greatest[i]}};
    found[i] = range_of(points, field, parallel);
    if (axes[i].has_bounds()) {
      check_axis(points, field, axes[i], found[i]);
    }
  }
  if (are_of_other_scales(axes, found)) {
    throw InvalidInput("has bounds in its LAS header that are those of another scale: it is damaged; copy it again");
  }
}

}  // namespace pds
