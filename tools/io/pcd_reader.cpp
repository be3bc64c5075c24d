// SPDX-License-Identifier: BSD-3-Clause
#include "io/pcd_reader.h"

#include "io/pcd_check.h"

#include <pcl_pds_recon/options.h>

#include <pcl/PCLPointCloud2.h>
#include <pcl/console/print.h>
#include <pcl/io/pcd_io.h>

#include <cstring>
#include <exception>
#include <utility>

namespace pds
{

namespace
{

pcl::PCLPointCloud2 read_cloud(const std::string& path, std::optional<Eigen::Vector3d>& sensor_origin)
{
  pcl::console::setVerbosityLevel(pcl::console::L_ALWAYS);  // errors are reported by the caller, in one line
  pcl::PCLPointCloud2 cloud;
  Eigen::Vector4f origin = Eigen::Vector4f::Zero();
  Eigen::Quaternionf orientation = Eigen::Quaternionf::Identity();
  int version = 0;
  std::string reason = "its header or data are damaged";
  int status = -1;
  try {
    status = pcl::PCDReader().read(path, cloud, origin, orientation, version);
  } catch (const std::exception& error) {
    reason = error.what();
  }
  const std::size_t points = std::size_t{cloud.width} * cloud.height;
  if (status < 0 || cloud.data.size() != points * cloud.point_step) {
    throw InvalidInput("PCL cannot read it (" + reason + "); write it again with the tool that made it");
  }
  const bool is_default = origin.head<3>().isZero(0) && orientation.isApprox(Eigen::Quaternionf::Identity());
  if (!is_default && origin.allFinite()) {
    sensor_origin = origin.head<3>().cast<double>();
  }
  return cloud;
}

/** A scalar of PCL's record and the field that it becomes. */
struct Source
{
  Field target;
  std::size_t offset;
  std::uint8_t datatype;
};

ScalarType scalar_type(std::uint8_t datatype)
{
  switch (datatype) {
    case pcl::PCLPointField::BOOL:
    case pcl::PCLPointField::UINT8:
      return ScalarType::uint8;
    case pcl::PCLPointField::INT8:
      return ScalarType::int8;
    case pcl::PCLPointField::INT16:
      return ScalarType::int16;
    case pcl::PCLPointField::UINT16:
      return ScalarType::uint16;
    case pcl::PCLPointField::INT32:
      return ScalarType::int32;
    case pcl::PCLPointField::UINT32:
      return ScalarType::uint32;
    case pcl::PCLPointField::FLOAT32:
      return ScalarType::float32;
    default:
      return ScalarType::float64;
  }
}

std::string ply_field_name(const std::string& name)
{
  for (const char axis : {'x', 'y', 'z'}) {
    if (name == std::string("normal_") + axis) {
      return std::string("n") + axis;
    }
  }
  return name;
}

void append_colors(const pcl::PCLPointField& field, std::vector<Source>& sources)
{
  // PCL packs a colour as 0xAARRGGBB, lowest byte first.
  constexpr std::pair<const char*, std::size_t> channels[] = {{"red", 2}, {"green", 1}, {"blue", 0}, {"alpha", 3}};
  const std::size_t count = field.name == "rgba" ? 4 : 3;
  for (std::size_t i = 0; i < count; ++i) {
    const auto& [name, byte] = channels[i];
    sources.push_back({{name, ScalarType::uint8}, field.offset + byte, pcl::PCLPointField::UINT8});
  }
}

std::vector<Source> list_sources(const pcl::PCLPointCloud2& cloud)
{
  std::vector<Source> sources;
  for (const pcl::PCLPointField& field : cloud.fields) {
    if (field.name == "_") {
      continue;  // padding
    }
    if (field.name == "rgb" || field.name == "rgba") {
      append_colors(field, sources);
      continue;
    }
    const std::string name = ply_field_name(field.name);
    const auto scalar_bytes = static_cast<std::size_t>(pcl::getFieldSize(field.datatype));
    for (std::size_t i = 0; i < field.count; ++i) {
      sources.push_back({{field.count == 1 ? name : name + "_" + std::to_string(i), scalar_type(field.datatype)},
                         field.offset + i * scalar_bytes,
                         field.datatype});
    }
  }
  return sources;
}

template <typename Integer>
double load_as_double(const std::uint8_t* source)
{
  Integer integer;
  std::memcpy(&integer, source, sizeof integer);
  return static_cast<double>(integer);
}

void copy_scalar(
    const std::uint8_t* bytes, const Source& source, PointTable& table, std::size_t row, const Field& target)
{
  const ScalarType type = scalar_type(source.datatype);
  if (source.datatype == pcl::PCLPointField::INT64) {
    table.set_value(row, target, load_as_double<std::int64_t>(bytes));
  } else if (source.datatype == pcl::PCLPointField::UINT64) {
    table.set_value(row, target, load_as_double<std::uint64_t>(bytes));
  } else if (type == target.type) {
    std::memcpy(table.record(row) + target.offset, bytes, size_of(type));
  } else {
    visit_scalar(type, [&](auto scalar) {
      std::memcpy(&scalar, bytes, sizeof scalar);
      table.set_value(row, target, static_cast<double>(scalar));
    });
  }
}

}  // namespace

PointTable read_pcd(const std::string& path, std::string_view file)
{
  check_pcd(file);
  std::optional<Eigen::Vector3d> sensor_origin;
  const pcl::PCLPointCloud2 cloud = read_cloud(path, sensor_origin);
  const std::vector<Source> sources = list_sources(cloud);

  std::vector<Field> fields;
  fields.reserve(sources.size());
  for (const Source& source : sources) {
    fields.push_back(source.target);
  }
  PointTable table(std::move(fields));
  table.sensor_origin = sensor_origin;
  table.resize(std::size_t{cloud.width} * cloud.height);
  for (const Source& source : sources) {
    const Field& target = *table.find(source.target.name);
    for (std::size_t row = 0; row < table.size(); ++row) {
      copy_scalar(cloud.data.data() + row * cloud.point_step + source.offset, source, table, row, target);
    }
  }
  return table;
}

}  // namespace pds
