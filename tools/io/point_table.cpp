// SPDX-License-Identifier: BSD-3-Clause
#include "io/point_table.h"

#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <set>
#include <utility>

namespace pds
{

namespace
{

auto find_field(std::vector<Field>& fields, const char* name)
{
  return std::find_if(fields.begin(), fields.end(), [name](const Field& field) { return field.name == name; });
}

bool contains_all(std::vector<Field>& fields, const FieldTriple& names)
{
  return std::all_of(names.begin(), names.end(),
                     [&fields](const char* name) { return find_field(fields, name) != fields.end(); });
}

/** Moves the fields of \a names to \a place and gives them one floating-point type, as Vector3View needs them. */
void gather_triple(std::vector<Field>& fields, const FieldTriple& names, std::size_t place)
{
  bool all_float = true;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = find_field(fields, names[i]);
    all_float = all_float && found->type == ScalarType::float32;
    const auto target = fields.begin() + static_cast<std::ptrdiff_t>(place + i);
    std::rotate(target, found, found + 1);
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    fields[place + i].type = all_float ? ScalarType::float32 : ScalarType::float64;
  }
}

bool may_be_color(const PointTable& points, const Field& field)
{
  if (field.type != ScalarType::float32 && field.type != ScalarType::float64) {
    return field.type == ScalarType::uint8 || field.type == ScalarType::uint16;
  }
  for (std::size_t row = 0; row < points.size(); ++row) {
    const double value = points.value(row, field);
    if (value < 0 || value > 1) {  // which NaN is not
      return false;
    }
  }
  return true;
}

}  // namespace

std::size_t size_of(ScalarType type)
{
  return visit_scalar(type, [](auto zero) { return sizeof zero; });
}

const char* ply_name(ScalarType type)
{
  switch (type) {
    case ScalarType::int8:
      return "char";
    case ScalarType::uint8:
      return "uchar";
    case ScalarType::int16:
      return "short";
    case ScalarType::uint16:
      return "ushort";
    case ScalarType::int32:
      return "int";
    case ScalarType::uint32:
      return "uint";
    case ScalarType::float32:
      return "float";
    case ScalarType::int64:
    case ScalarType::uint64:
    case ScalarType::float64:
      break;
  }
  return "double";
}

bool is_one_of(const std::string& name, const FieldTriple& names)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

PointTable::PointTable(std::vector<Field> fields, std::size_t size) : fields_(std::move(fields))
{
  std::set<std::string> names;
  for (const Field& field : fields_) {
    if (!names.insert(field.name).second) {
      throw InvalidInput("the field '" + field.name + "' appears twice; give each field a name of its own");
    }
  }
  if (!contains_all(fields_, position_fields)) {
    throw InvalidInput("has no coordinates x, y and z; name the three fields so");
  }
  gather_triple(fields_, position_fields, 0);
  has_normals_ = contains_all(fields_, normal_fields);
  if (has_normals_) {
    gather_triple(fields_, normal_fields, position_fields.size());
  }
  has_viewpoints_ = contains_all(fields_, viewpoint_fields);
  if (has_viewpoints_) {
    gather_triple(fields_, viewpoint_fields, position_fields.size() + (has_normals_ ? normal_fields.size() : 0));
  }
  for (Field& field : fields_) {
    field.offset = record_bytes_;
    record_bytes_ += size_of(field.type);
  }
  resize(size);
}

void PointTable::resize(std::size_t size)
{
  std::unique_ptr<std::byte[], Free> records(static_cast<std::byte*>(std::calloc(size, record_bytes_)));
  if (!records && size > 0) {
    throw std::bad_alloc();
  }
  if (const std::size_t kept = std::min(size, size_); kept > 0) {
    std::memcpy(records.get(), records_.get(), kept * record_bytes_);
  }
  records_ = std::move(records);
  size_ = size;
}

const Field* PointTable::find(const std::string& name) const
{
  const auto found =
      std::find_if(fields_.begin(), fields_.end(), [&name](const Field& field) { return field.name == name; });
  return found == fields_.end() ? nullptr : &*found;
}

std::optional<ScalarType> PointTable::color_type() const
{
  const Field* first = find(color_fields.front());
  if (!first || !std::all_of(color_fields.begin(), color_fields.end(), [this, first](const char* name) {
        const Field* field = find(name);
        return field && field->type == first->type && may_be_color(*this, *field);
      })) {
    return std::nullopt;
  }
  return first->type;
}

double PointTable::value(std::size_t i, const Field& field) const
{
  return visit_scalar(field.type, [source = record(i) + field.offset](auto scalar) {
    std::memcpy(&scalar, source, sizeof scalar);
    return static_cast<double>(scalar);
  });
}

void PointTable::set_value(std::size_t i, const Field& field, double value)
{
  visit_scalar(field.type, [target = record(i) + field.offset, value](auto zero) {
    const auto scalar = static_cast<decltype(zero)>(value);
    std::memcpy(target, &scalar, sizeof scalar);
  });
}

PointTable PointTable::select(const std::vector<std::uint32_t>& indices, std::size_t count) const
{
  PointTable selected(fields_, count);
  for (std::size_t i = 0; i < count; ++i) {
    std::memcpy(selected.record(i), record(indices[i]), record_bytes_);
  }
  selected.z_is_up = z_is_up;
  return selected;
}

PointTable PointTable::with_fields(const std::vector<Field>& added, const Parallel& parallel) const
{
  const auto replaced = [&added](const Field& field) {
    return std::any_of(added.begin(), added.end(), [&field](const Field& other) { return other.name == field.name; });
  };
  std::vector<Field> kept;
  std::remove_copy_if(fields_.begin(), fields_.end(), std::back_inserter(kept), replaced);
  std::vector<Field> all = kept;
  all.insert(all.end(), added.begin(), added.end());

  PointTable table(all, size_);
  table.sensor_origin = sensor_origin;
  table.z_is_up = z_is_up;
  table.not_read = not_read;
  constexpr std::size_t block = std::size_t{1} << 13;  // rows; both tables' stay in the cache from field to field
  parallel.blocks(size_, block, [&](std::size_t begin, std::size_t end, unsigned) {
    for (const Field& source : kept) {
      const Field& target = *table.find(source.name);
      visit_scalar(source.type, [&](auto scalar) {
        for (std::size_t i = begin; i < end; ++i) {
          std::memcpy(&scalar, record(i) + source.offset, sizeof scalar);
          std::memcpy(table.record(i) + target.offset, &scalar, sizeof scalar);
        }
      });
    }
  });
  return table;
}

Vector3View PointTable::vectors_at(const Field& first) const
{
  const std::byte* data = records_.get() + first.offset;
  return first.type == ScalarType::float64 ? Vector3View(reinterpret_cast<const double*>(data), record_bytes_)
                                           : Vector3View(reinterpret_cast<const float*>(data), record_bytes_);
}

PointCloudView PointTable::view() const
{
  PointCloudView view;
  view.size = size_;
  view.positions = vectors_at(fields_.front());
  if (has_normals_) {
    view.normals = vectors_at(fields_[position_fields.size()]);
  }
  if (has_viewpoints_) {
    view.viewpoints = vectors_at(*find(viewpoint_fields.front()));
  }
  view.sensor_origin = sensor_origin;
  view.record_less = [this](std::uint32_t a, std::uint32_t b) {
    return std::memcmp(record(a), record(b), record_bytes_) < 0;
  };
  return view;
}

}  // namespace pds
