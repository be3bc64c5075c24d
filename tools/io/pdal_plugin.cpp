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

/** All but the mark of points without coordinates. */
std::vector<pdal::Dimension::Id> dimensions(const pdal::PointLayout& layout)
{
  std::vector<pdal::Dimension::Id> all = layout.dims();
  all.erase(std::remove(all.begin(), all.end(), pdal::Dimension::Id::Omit), all.end());
  return all;
}

PointTable make_table(const pdal::PointLayout& layout, std::size_t size)
{
  std::vector<Field> fields;
  for (const pdal::Dimension::Id dimension : dimensions(layout)) {
    fields.push_back({field_name(layout.dimName(dimension)), scalar_type(layout.dimType(dimension))});
  }
  return PointTable(std::move(fields), size);
}

using PointIds = std::vector<pdal::PointId>;

/** A scanner's E57 has a place for every ray, and marks those that met nothing. */
PointIds find_points_with_coordinates(const pdal::PointView& view)
{
  PointIds found;
  const bool has_marks = view.hasDim(pdal::Dimension::Id::Omit);
  for (pdal::PointId i = 0; i < view.size(); ++i) {
    if (!has_marks || view.getFieldAs<int>(pdal::Dimension::Id::Omit, i) == 0) {
      found.push_back(i);
    }
  }
  return found;
}

void copy_points(const pdal::PointView& view, const PointIds& ids, PointTable& table, std::size_t first)
{
  const pdal::PointLayout& layout = *view.layout();
  for (const pdal::Dimension::Id dimension : dimensions(layout)) {
    const Field& field = *table.find(field_name(layout.dimName(dimension)));
    visit_scalar(field.type, [&](auto zero) {
      for (std::size_t i = 0; i < ids.size(); ++i) {
        const auto scalar = view.getFieldAs<decltype(zero)>(dimension, ids[i]);
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
  std::size_t size = 0;
  std::size_t found = 0;
  std::vector<std::pair<pdal::PointViewPtr, PointIds>> parts;
  for (const pdal::PointViewPtr& view : pipeline.views()) {
    parts.emplace_back(view, find_points_with_coordinates(*view));
    size += view->size();
    found += parts.back().second.size();
  }
  if (size < announced) {  // of which PDAL says nothing
    throw std::runtime_error("it holds " + std::to_string(size) + " of " + std::to_string(announced) + " points");
  }
  PointTable table = make_table(*pipeline.pointTable().layout(), found);
  std::size_t first = 0;
  for (const auto& [view, ids] : parts) {
    copy_points(*view, ids, table, first);
    first += ids.size();
  }
  if (found < size) {
    table.not_read = std::to_string(size - found) + " points without coordinates";
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
