// SPDX-License-Identifier: BSD-3-Clause
#include "io/merge_points.h"

#include "io/record_reader.h"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace pds
{

namespace
{

/** Whether a scalar of type \a target holds every value of type \a source. */
bool holds(ScalarType target, ScalarType source)
{
  return visit_scalar(target, [source](auto target_zero) {
    using Target = std::numeric_limits<decltype(target_zero)>;
    return visit_scalar(source, [](auto source_zero) {
      using Source = std::numeric_limits<decltype(source_zero)>;
      return (Source::is_integer || !Target::is_integer) && (Target::is_signed || !Source::is_signed) &&
             Target::digits >= Source::digits;
    });
  });
}

/** The smallest type that holds the values of both; double if none does. */
ScalarType common_type(ScalarType a, ScalarType b)
{
  for (const ScalarType type :
       {ScalarType::uint8, ScalarType::int8, ScalarType::uint16, ScalarType::int16, ScalarType::uint32,
        ScalarType::int32, ScalarType::float32, ScalarType::uint64, ScalarType::int64}) {
    if (holds(type, a) && holds(type, b)) {
      return type;
    }
  }
  return ScalarType::float64;
}

std::vector<Field> common_fields(const std::vector<PointTable>& clouds)
{
  std::vector<Field> fields;
  for (const PointTable& cloud : clouds) {
    for (const Field& field : cloud.fields()) {
      const auto same =
          std::find_if(fields.begin(), fields.end(), [&field](const Field& other) { return other.name == field.name; });
      if (field.name == scan_field) {
        continue;
      }
      if (same == fields.end()) {
        fields.push_back({field.name, field.type});
      } else {
        same->type = common_type(same->type, field.type);
      }
    }
  }
  fields.push_back({scan_field, ScalarType::uint16});
  return fields;
}

/** Adds the viewpoints' fields that are missing, of the type of the positions. */
void add_viewpoints(std::vector<Field>& fields)
{
  const auto find = [&fields](const char* name) {
    return std::find_if(fields.begin(), fields.end(), [name](const Field& field) { return field.name == name; });
  };
  const bool is_float = find("x")->type == ScalarType::float32;
  for (const char* name : viewpoint_names) {
    if (find(name) == fields.end()) {
      fields.push_back({name, is_float ? ScalarType::float32 : ScalarType::float64});
    }
  }
}

RecordLayout layout_of(const PointTable& cloud)
{
  RecordLayout layout;
  layout.record_bytes = cloud.record_bytes();
  for (const Field& field : cloud.fields()) {
    if (field.name != scan_field) {
      layout.columns.push_back({field.name, field.type, field.offset});
    }
  }
  return layout;
}

/** Fields that are integers are zero from the start. */
void mark_missing(const PointTable& cloud, PointTable& merged, std::size_t begin, std::size_t end)
{
  for (const Field& field : merged.fields()) {
    const bool is_floating = field.type == ScalarType::float32 || field.type == ScalarType::float64;
    for (std::size_t row = begin; row < end && is_floating && !cloud.find(field.name); ++row) {
      merged.set_value(row, field, std::numeric_limits<double>::quiet_NaN());
    }
  }
}

/** The sensor's place to each point of a cloud that has no viewpoints of its own. */
void mark_viewpoint(const Eigen::Vector3d& origin, PointTable& merged, std::size_t begin, std::size_t end)
{
  for (std::size_t axis = 0; axis < viewpoint_names.size(); ++axis) {
    const Field& field = *merged.find(viewpoint_names[axis]);
    for (std::size_t row = begin; row < end; ++row) {
      merged.set_value(row, field, origin[static_cast<Eigen::Index>(axis)]);
    }
  }
}

/** Colours of 8 bits in a table whose colours have 16: 255 becomes 65535. */
void widen_colors(PointTable& merged, std::size_t begin, std::size_t end)
{
  constexpr double factor = 257;
  for (const char* name : {"red", "green", "blue"}) {
    const Field& field = *merged.find(name);
    for (std::size_t row = begin; row < end; ++row) {
      merged.set_value(row, field, merged.value(row, field) * factor);
    }
  }
}

void append(const PointTable& cloud, double number, PointTable& merged, std::size_t first, const Parallel& parallel)
{
  const RecordLayout layout = layout_of(cloud);
  const Field& scan = *merged.find(scan_field);
  const bool widens_colors = cloud.color_type() == ScalarType::uint8 && merged.color_type() == ScalarType::uint16;
  constexpr std::size_t block = std::size_t{1} << 13;  // rows; they stay in the cache from field to field
  parallel.blocks(cloud.size(), block, [&](std::size_t begin, std::size_t end, unsigned) {
    copy_records(cloud.record(begin), layout, end - begin, merged, first + begin);
    mark_missing(cloud, merged, first + begin, first + end);
    if (cloud.sensor_origin && merged.has_viewpoints() && !cloud.has_viewpoints()) {
      mark_viewpoint(*cloud.sensor_origin, merged, first + begin, first + end);
    }
    if (widens_colors) {
      widen_colors(merged, first + begin, first + end);
    }
    for (std::size_t row = begin; row < end; ++row) {
      merged.set_value(first + row, scan, number);
    }
  });
}

}  // namespace

PointTable merge_points(std::vector<PointTable> clouds, const Parallel& parallel)
{
  std::size_t size = 0;
  bool have_same_origin = true;
  for (const PointTable& cloud : clouds) {
    size += cloud.size();
    have_same_origin = have_same_origin && cloud.sensor_origin == clouds.front().sensor_origin;
  }
  std::vector<Field> fields = common_fields(clouds);
  if (!have_same_origin) {
    add_viewpoints(fields);
  }
  PointTable merged(std::move(fields), size);
  if (have_same_origin) {
    merged.sensor_origin = clouds.front().sensor_origin;
  }
  std::size_t first = 0;
  double number = 0;
  for (PointTable& cloud : clouds) {
    append(cloud, ++number, merged, first, parallel);
    first += cloud.size();
    cloud.resize(0);
  }
  return merged;
}

}  // namespace pds
