// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io/point_table.h"
#include "las_testing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <random>
#include <set>

// A cloud with coordinates of UTM, on a sphere of 10 m, that every format must carry to the last bit.

namespace pds
{

using Position = std::array<double, 3>;

constexpr std::size_t utm_points = 3000;

/** \brief What LAS can hold as well: whole millimetres, as scale times integer plus offset in double. */
inline std::vector<std::array<std::int32_t, 3>> las_numbers()
{
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  std::vector<std::array<std::int32_t, 3>> numbers(utm_points);
  for (auto& row : numbers) {
    const Position p = {normal(random), normal(random), normal(random)};
    const double scale = 10000 / std::hypot(p[0], p[1], p[2]);
    std::transform(p.begin(), p.end(), row.begin(),
                   [scale](double x) { return static_cast<std::int32_t>(std::lround(scale * x)); });
  }
  return numbers;
}

inline std::vector<Position> positions()
{
  std::vector<Position> all;
  for (const auto& [x, y, z] : las_numbers()) {
    all.push_back({0.001 * x + 500000, 0.001 * y + 5000000, 0.001 * z});
  }
  return all;
}

/** \brief The cloud as LAS. */
inline std::string utm_las(std::uint32_t added_to_count = 0)
{
  LasFile file(2, 0, 20);
  file.set(131, Position{0.001, 0.001, 0.001});
  for (const auto& [x, y, z] : las_numbers()) {
    file.add(las_record(x, y, z, 2));
  }
  file.set(107, static_cast<std::uint32_t>(utm_points) + added_to_count);
  return file.bytes();
}

/** \brief Whether each coordinate is one that the scale and offset of utm_las() can give, to the last bit. */
inline testing::AssertionResult has_only_las_coordinates(const PointTable& mesh)
{
  constexpr Position offset = {500000, 5000000, 0};
  for (std::size_t row = 0; row < mesh.size(); ++row) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double value = mesh.value(row, mesh.fields()[axis]);
      if (value != 0.001 * static_cast<double>(std::lround((value - offset[axis]) / 0.001)) + offset[axis]) {
        return testing::AssertionFailure()
               << std::setprecision(17) << "vertex " << row << " has the coordinate " << value;
      }
    }
  }
  return testing::AssertionSuccess();
}

/** \brief Whether each vertex is a point of the cloud to the last bit. */
inline testing::AssertionResult has_only_points_of_the_cloud(const PointTable& mesh)
{
  const std::vector<Position> input = positions();
  const std::set<Position> all(input.begin(), input.end());
  if (mesh.size() <= 50) {
    return testing::AssertionFailure() << "only " << mesh.size() << " vertices";
  }
  for (std::size_t row = 0; row < mesh.size(); ++row) {
    const std::vector<double> values = row_values(mesh, row);
    if (all.count({values[0], values[1], values[2]}) == 0) {
      return testing::AssertionFailure() << std::setprecision(17) << "vertex " << row
                                         << " is no point of the cloud: " << values[0] << ' ' << values[1] << ' '
                                         << values[2];
    }
  }
  return testing::AssertionSuccess();
}

}  // namespace pds
