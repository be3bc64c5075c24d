// SPDX-License-Identifier: BSD-3-Clause
#include "io/merge_points.h"

#include "io/colors.h"
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
  for (const char* name : viewpoint_fields) {
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
  for (std::size_t axis = 0; axis < viewpoint_fields.size(); ++axis) {
    const Field& field = *merged.find(viewpoint_fields[axis]);
    for (std::size_t row = begin; row < end; ++row) {
      merged.set_value(row, field, origin[static_cast<Eigen::Index>(axis)]);
    }
  }
}

/** Whether whatever is called red, green or blue in any of the clouds is a colour, and so can be scaled. */
bool have_only_colors(const std::vector<PointTable>& clouds)
{
  return std::all_of(clouds.begin(), clouds.end(), [](const PointTable& cloud) {
    const bool has_any = std::any_of(color_fields.begin(), color_fields.end(),
                                     [&cloud](const char* name) { return cloud.find(name) != nullptr; });
    return !has_any || cloud.color_type();
  });
}

/** Full brightness of \a from becomes that of \a to. */
void scale_colors(PointTable& merged, std::size_t begin, std::size_t end, double from, double to)
{
  for (const char* name : color_fields) {
    const Field& field = *merged.find(name);
    for (std::size_t row = begin; row < end; ++row) {
      merged.set_value(row, field, merged.value(row, field) * to / from);
    }
  }
}

void append(const PointTable& cloud,
            double number,
            bool scales_colors,
            PointTable& merged,
            std::size_t first,
            const Parallel& parallel)
{
  const RecordLayout layout = layout_of(cloud);
  const Field& scan = *merged.find(scan_field);
  const Field* red = scales_colors ? cloud.find(color_fields.front()) : nullptr;
  const double from = red ? full_brightness(red->type) : 1;
  const double to = red ? full_brightness(merged.find(color_fields.front())->type) : 1;
  constexpr std::size_t block = std::size_t{1} << 13;  // rows; they stay in the cache from field to field
  parallel.blocks(cloud.size(), block, [&](std::size_t begin, std::size_t end, unsigned) {
    copy_records(cloud.record(begin), layout, end - begin, merged, first + begin);
    mark_missing(cloud, merged, first + begin, first + end);
    if (cloud.sensor_origin && merged.has_viewpoints() && !cloud.has_viewpoints()) {
      mark_viewpoint(*cloud.sensor_origin, merged, first + begin, first + end);
    }
    if (from != to) {
      scale_colors(merged, first + begin, first + end, from, to);
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
  bool z_is_up = false;
  bool have_same_origin = true;
  for (const PointTable& cloud : clouds) {
    size += cloud.size();
    z_is_up = z_is_up || cloud.z_is_up;
    have_same_origin = have_same_origin && cloud.sensor_origin == clouds.front().sensor_origin;
  }
  const bool scales_colors = have_only_colors(clouds);
  std::vector<Field> fields = common_fields(clouds);
  if (!have_same_origin) {
    add_viewpoints(fields);
  }
  PointTable merged(std::move(fields), size);
  merged.z_is_up = z_is_up;
  if (have_same_origin) {
    merged.sensor_origin = clouds.front().sensor_origin;
  }
  std::size_t first = 0;
  double number = 0;
  for (PointTable& cloud : clouds) {
    append(cloud, ++number, scales_colors, merged, first, parallel);
    first += cloud.size();
    cloud.resize(0);
  }
  return merged;
}

}  // namespace pds
