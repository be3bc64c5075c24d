// SPDX-License-Identifier: BSD-3-Clause
#include <pcl/common/io.h>
#include <pcl/surface/impl/poisson_disk_adapter.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>

namespace pcl::detail
{
namespace
{

template <typename Scalar>
Scalar load(const std::uint8_t* at)
{
  Scalar value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

template <typename Scalar>
void store(std::uint8_t* at, double value)
{
  const auto scalar = static_cast<Scalar>(value);
  std::memcpy(at, &scalar, sizeof scalar);
}

/** \brief One vertex and the points of its cell. */
class Cell
{
 public:
  Cell(const PointRecords& cloud, const pds::MovedVertices& moved, std::size_t vertex, std::uint8_t* record)
      : cloud_(cloud),
        begin_(moved.cell_point.data() + moved.cell_begin[vertex]),
        end_(moved.cell_point.data() + moved.cell_begin[vertex + 1]),
        position_(moved.position[vertex]),
        record_(record)
  {
  }

  template <typename Scalar>
  void takeScalars(const PCLPointField& field) const
  {
    const int axis = axisOf(field.name, {"x", "y", "z"});
    for (std::size_t i = 0; i < field.count; ++i) {
      const std::size_t offset = field.offset + i * sizeof(Scalar);
      store<Scalar>(record_ + offset, axis >= 0 ? position_[axis] : mean<Scalar>(offset));
    }
  }

  /** \brief Colours are four bytes under one name. */
  void takeColor(const PCLPointField& field) const
  {
    for (std::size_t channel = 0; channel < 4; ++channel) {
      const std::size_t offset = field.offset + channel;
      store<std::uint8_t>(record_ + offset, std::round(mean<std::uint8_t>(offset)));
    }
  }

  /** \brief Means of unit vectors are shorter; where they cancel out the seed's normal stays. */
  void restoreNormal(const std::array<std::size_t, 3>& offsets, const std::uint8_t* seed) const
  {
    std::array<double, 3> normal{};
    for (std::size_t axis = 0; axis < 3; ++axis)
      normal[axis] = static_cast<double>(load<float>(record_ + offsets[axis]));
    const double length = std::hypot(normal[0], normal[1], normal[2]);
    for (std::size_t axis = 0; axis < 3; ++axis)
      store<float>(record_ + offsets[axis],
                   length > 0 ? normal[axis] / length : static_cast<double>(load<float>(seed + offsets[axis])));
  }

  static int axisOf(const std::string& name, const std::array<const char*, 3>& names)
  {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? -1 : static_cast<int>(found - names.begin());
  }

 private:
  /** \brief Of the points that have a value; NaN if none has. */
  template <typename Scalar>
  double mean(std::size_t offset) const
  {
    double sum = 0;
    std::size_t count = 0;
    for (const std::uint32_t* point = begin_; point != end_; ++point) {
      const auto value = static_cast<double>(load<Scalar>(cloud_.data + *point * cloud_.stride + offset));
      if (!std::isfinite(value)) continue;
      sum += value;
      ++count;
    }
    return sum / static_cast<double>(count);
  }

  const PointRecords& cloud_;
  const std::uint32_t *begin_, *end_;
  Eigen::Vector3d position_;
  std::uint8_t* record_;
};

}  // namespace

void applyMoves(const PoissonDiskResult& result, const PointRecords& cloud, std::uint8_t* vertices)
{
  constexpr std::size_t missing = ~std::size_t{0};
  std::array<std::size_t, 3> normal{missing, missing, missing};
  for (const PCLPointField& field : cloud.fields) {
    const int axis = Cell::axisOf(field.name, {"normal_x", "normal_y", "normal_z"});
    if (axis >= 0 && field.datatype == PCLPointField::FLOAT32) normal[static_cast<std::size_t>(axis)] = field.offset;
  }
  const bool has_normals = std::find(normal.begin(), normal.end(), missing) == normal.end();
  for (std::size_t v = 0; v < result.moved.position.size(); ++v) {
    const Cell cell(cloud, result.moved, v, vertices + v * cloud.stride);
    for (const PCLPointField& field : cloud.fields) {
      if (field.name == "rgb" || field.name == "rgba")
        cell.takeColor(field);
      else if (field.datatype == PCLPointField::FLOAT32)
        cell.takeScalars<float>(field);
      else if (field.datatype == PCLPointField::FLOAT64)
        cell.takeScalars<double>(field);
    }
    const auto seed = static_cast<std::size_t>(result.seeds[v]);
    if (has_normals) cell.restoreNormal(normal, cloud.data + seed * cloud.stride);
  }
}

}  // namespace pcl::detail
