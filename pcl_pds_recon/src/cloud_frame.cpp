// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_frame.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace pds
{
namespace
{

constexpr std::size_t block = 16384;        // points per block: some 0.1 ms
constexpr std::size_t sample_size = 4096;   // points that the median is guessed from ...
constexpr std::size_t sample_margin = 128;  // ... and ranks on either side of it: four standard deviations
constexpr double infinity = std::numeric_limits<double>::infinity();

/** \brief For each axis an interval in which the median is looked for. */
struct Brackets
{
  Eigen::Vector3d low = Eigen::Vector3d::Constant(-infinity);
  Eigen::Vector3d high = Eigen::Vector3d::Constant(infinity);
};

/** \brief Narrow brackets around the median of a sample, for clouds that are much larger. A bad guess costs time only.
 */
Brackets guess_brackets(const PointCloudView& cloud)
{
  Brackets brackets;
  if (cloud.size <= 2 * sample_size) return brackets;
  std::vector<Eigen::Vector3d> sample;
  for (std::uint32_t i = 0; i < sample_size; ++i) {
    // Multiples of the golden ratio are spread evenly, without a period that a scan's lines could have.
    const std::uint64_t fraction = i * 2654435769U;
    const Eigen::Vector3d p = cloud.positions[(fraction * cloud.size) >> 32];
    if (p.allFinite()) sample.push_back(p);
  }
  if (sample.size() <= 2 * sample_margin) return brackets;
  for (int axis = 0; axis < 3; ++axis) {
    const auto below = [axis](const Eigen::Vector3d& a, const Eigen::Vector3d& b) { return a[axis] < b[axis]; };
    const auto select = [&](std::size_t rank) {
      const auto place = sample.begin() + static_cast<std::ptrdiff_t>(rank);
      std::nth_element(sample.begin(), place, sample.end(), below);
      return (*place)[axis];
    };
    brackets.low[axis] = select(sample.size() / 2 - sample_margin);
    brackets.high[axis] = select(sample.size() / 2 + sample_margin);
  }
  return brackets;
}

/** \brief What one pass over points finds. */
struct Survey
{
  std::size_t finite = 0;
  Bounds bounds;
  std::array<std::size_t, 3> below{};            ///< coordinates below their bracket
  std::array<std::vector<double>, 3> bracketed;  ///< those in it, in any order

  Survey& operator+=(const Survey& other)
  {
    finite += other.finite;
    bounds += other.bounds;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      below[axis] += other.below[axis];
      bracketed[axis].insert(bracketed[axis].end(), other.bracketed[axis].begin(), other.bracketed[axis].end());
    }
    return *this;
  }
};

/** \brief Finite points, a few at a time and axis by axis: loops over them become vector code. */
struct Columns
{
  static constexpr std::size_t capacity = 256;

  /** \brief Takes the points begin ... end - 1 of the cloud, at most as many as there is room for. */
  void load(const PointCloudView& cloud, std::size_t begin, std::size_t end)
  {
    count = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d p = cloud.positions[i];
      for (int axis = 0; axis < 3; ++axis) value[axis][count] = p[axis];
      count += p.allFinite() ? 1U : 0U;
    }
  }

  double value[3][capacity];
  std::size_t count = 0;
};

/** \brief Adds one axis of the points to what was found. */
void survey_axis(const Columns& columns, std::size_t axis, double low, double high, Survey& found)
{
  const double* const value = columns.value[axis];
  double least = found.bounds.low[static_cast<int>(axis)];
  double greatest = found.bounds.high[static_cast<int>(axis)];
  std::size_t below = 0;
  double bracketed[Columns::capacity];
  std::size_t count = 0;
  for (std::size_t i = 0; i < columns.count; ++i) {
    least = value[i] < least ? value[i] : least;
    greatest = value[i] > greatest ? value[i] : greatest;
    below += value[i] < low ? 1U : 0U;
    // Without a branch: every value is written, and stays if the next place is beyond it.
    bracketed[count] = value[i];
    const bool is_bracketed = (value[i] >= low) & (value[i] <= high);
    count += is_bracketed ? 1U : 0U;
  }
  found.bounds.low[static_cast<int>(axis)] = least;
  found.bounds.high[static_cast<int>(axis)] = greatest;
  found.below[axis] += below;
  found.bracketed[axis].insert(found.bracketed[axis].end(), bracketed, bracketed + count);
}

Survey survey(const PointCloudView& cloud, const Brackets& brackets, const Parallel& parallel)
{
  return parallel.sum(cloud.size, block, [&](std::size_t begin, std::size_t end) {
    Survey found;
    Columns columns;
    for (std::size_t first = begin; first < end; first += Columns::capacity) {
      columns.load(cloud, first, std::min(first + Columns::capacity, end));
      found.finite += columns.count;
      for (int axis = 0; axis < 3; ++axis)
        survey_axis(columns, static_cast<std::size_t>(axis), brackets.low[axis], brackets.high[axis], found);
    }
    return found;
  });
}

}  // namespace

CloudFrame measure_frame(const PointCloudView& cloud, const Parallel& parallel)
{
  Brackets brackets = guess_brackets(cloud);
  Survey found = survey(cloud, brackets, parallel);
  const std::size_t middle = found.finite / 2;
  const auto missed = [&](std::size_t axis) {
    return middle < found.below[axis] || middle >= found.below[axis] + found.bracketed[axis].size();
  };
  if (found.finite > 0 && (missed(0) || missed(1) || missed(2))) found = survey(cloud, Brackets(), parallel);

  CloudFrame frame{found.finite, found.bounds};
  for (std::size_t axis = 0; axis < 3 && found.finite > 0; ++axis) {
    std::vector<double>& values = found.bracketed[axis];
    const auto place = values.begin() + static_cast<std::ptrdiff_t>(middle - found.below[axis]);
    std::nth_element(values.begin(), place, values.end());
    frame.median[static_cast<int>(axis)] = *place;
  }
  return frame;
}

}  // namespace pds
