// SPDX-License-Identifier: BSD-3-Clause
#include "io/cell_means.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pds
{

namespace
{

constexpr std::size_t vertices_per_block = 256;

bool is_quantity(const Field& field)
{
  static const char* const names[] = {"red", "green", "blue", "alpha", "intensity"};
  return field.type == ScalarType::float32 || field.type == ScalarType::float64 ||
         std::find(std::begin(names), std::end(names), field.name) != std::end(names);
}

bool is_whole(ScalarType type)
{
  return visit_scalar(type, [](auto zero) { return std::is_integral_v<decltype(zero)>; });
}

/** \brief Mean of a field over the cell of a vertex; NaN if no point has a value. */
double cell_mean(const PointTable& points, const Field& field, const MovedVertices& moved, std::size_t vertex)
{
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = moved.cell_begin[vertex]; i < moved.cell_begin[vertex + 1]; ++i) {
    const double value = points.value(moved.cell_point[i], field);
    if (std::isfinite(value)) {
      sum += value;
      ++count;
    }
  }
  const double mean = sum / static_cast<double>(count);
  return is_whole(field.type) ? std::round(mean) : mean;
}

/** Means of unit vectors are shorter; where they cancel out the seed's normal stays. */
void take_normal(
    PointTable& vertices, const PointTable& points, const MovedVertices& moved, const Field* normal, std::size_t vertex)
{
  Eigen::Vector3d mean;
  for (int axis = 0; axis < 3; ++axis) {
    mean[axis] = cell_mean(points, normal[axis], moved, vertex);
  }
  const double length = mean.norm();
  for (int axis = 0; axis < 3 && length > 0; ++axis) {
    vertices.set_value(vertex, normal[axis], mean[axis] / length);
  }
}

}  // namespace

void apply_moves(PointTable& vertices, const PointTable& points, const MovedVertices& moved, const Parallel& parallel)
{
  const std::vector<Field>& fields = points.fields();
  const std::size_t first_attribute = points.has_normals() ? 6 : 3;
  parallel.each(moved.position.size(), vertices_per_block, [&](std::size_t v) {
    for (int axis = 0; axis < 3; ++axis) {
      vertices.set_value(v, fields[static_cast<std::size_t>(axis)], moved.position[v][axis]);
    }
    if (points.has_normals()) {
      take_normal(vertices, points, moved, &fields[3], v);
    }
    for (std::size_t f = first_attribute; f < fields.size(); ++f) {
      if (is_quantity(fields[f])) {
        vertices.set_value(v, fields[f], cell_mean(points, fields[f], moved, v));
      }
    }
  });
}

}  // namespace pds
