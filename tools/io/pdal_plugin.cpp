// SPDX-License-Identifier: BSD-3-Clause
#include "io/pdal_reader.h"

#include "io/snake_case.h"

#include <pdal/PipelineManager.hpp>
#include <pdal/PointView.hpp>
#include <pdal/StageFactory.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace pds
{

namespace
{

ScalarType scalar_type(pdal::Dimension::Type type)
{
  using pdal::Dimension::Type;
  switch (type) {
    case Type::Signed8:
      return ScalarType::int8;
    case Type::Unsigned8:
      return ScalarType::uint8;
    case Type::Signed16:
      return ScalarType::int16;
    case Type::Unsigned16:
      return ScalarType::uint16;
    case Type::Signed32:
      return ScalarType::int32;
    case Type::Unsigned32:
      return ScalarType::uint32;
    case Type::Signed64:
      return ScalarType::int64;
    case Type::Unsigned64:
      return ScalarType::uint64;
    case Type::Float:
      return ScalarType::float32;
    default:
      return ScalarType::float64;
  }
}

/** PointSourceId is point_source_id. */
std::string field_name(const std::string& name)
{
  constexpr std::array<std::pair<const char*, const char*>, 4> own_names = {
      {{"NormalX", "nx"}, {"NormalY", "ny"}, {"NormalZ", "nz"}, {"ScanAngleRank", "scan_angle"}}};
  for (const auto& [pdal_name, own_name] : own_names) {
    if (name == pdal_name) {
      return own_name;
    }
  }
  return snake_case(name);
}

PointTable make_table(const pdal::PointLayout& layout, std::size_t size)
{
  std::vector<Field> fields;
  for (const pdal::Dimension::Id dimension : layout.dims()) {
    fields.push_back({field_name(layout.dimName(dimension)), scalar_type(layout.dimType(dimension))});
  }
  return PointTable(std::move(fields), size);
}

void copy_points(const pdal::PointView& view, const pdal::PointLayout& layout, PointTable& table, std::size_t first)
{
  for (const pdal::Dimension::Id dimension : layout.dims()) {
    const Field& field = *table.find(field_name(layout.dimName(dimension)));
    visit_scalar(field.type, [&](auto zero) {
      for (pdal::PointId i = 0; i < view.size(); ++i) {
        const auto scalar = view.getFieldAs<decltype(zero)>(dimension, i);
        std::memcpy(table.record(first + i) + field.offset, &scalar, sizeof scalar);
      }
    });
  }
}

std::string in_one_line(std::string text)
{
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

PointTable read(const std::string& path)
{
  pdal::PipelineManager pipeline;
  pipeline.setLog(pdal::Log::makeLog("", "devnull"));  // what goes wrong is reported by the caller, in one line
  const std::string driver = pdal::StageFactory::inferReaderDriver(path);
  pdal::Options options;
  if (driver == "readers.las") {
    options.add("use_eb_vlr", true);  // extra bytes before version 1.4 as well
  }
  const std::size_t announced = pipeline.makeReader(path, driver, options).preview().m_pointCount;
  pipeline.prepare();
  pipeline.execute();
  const pdal::PointLayout& layout = *pipeline.pointTable().layout();
  std::size_t size = 0;
  for (const pdal::PointViewPtr& view : pipeline.views()) {
    size += view->size();
  }
  if (size < announced) {  // of which PDAL says nothing
    throw std::runtime_error("it holds " + std::to_string(size) + " of " + std::to_string(announced) + " points");
  }
  PointTable table = make_table(layout, size);
  std::size_t first = 0;
  for (const pdal::PointViewPtr& view : pipeline.views()) {
    copy_points(*view, layout, table, first);
    first += view->size();
  }
  return table;
}

}  // namespace

void pcl_pds_recon_read_with_pdal(const std::string& path, std::optional<PointTable>& table, std::string& complaint)
{
  try {
    table = read(path);
  } catch (const std::exception& error) {
    complaint = "PDAL cannot read it (" + in_one_line(error.what()) + "); copy it again or write it anew";
  }
}

}  // namespace pds
