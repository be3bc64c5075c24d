// SPDX-License-Identifier: BSD-3-Clause
#include "io/pdal_reader.h"

#include "io/e57_check.h"
#include "io/snake_case.h"

#include <pcl_pds_recon/options.h>

#include <pdal/PipelineManager.hpp>
#include <pdal/PointView.hpp>
#include <pdal/Stage.hpp>

#include <algorithm>
#include <array>
#include <boost/algorithm/string/replace.hpp>
#include <cstddef>
#include <cstring>
#include <new>
#include <regex>
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

/** A dimension, or some bits of it. */
struct Column
{
  Field field;
  pdal::Dimension::Id dimension;
  unsigned shift = 0;
  int mask = 0;  ///< 0: all of it
};

/** The flags of a point have fields of their own, as in read_las; PDAL before 2.6 leaves them in one byte. */
void add_flags(std::vector<Column>& columns, pdal::Dimension::Id dimension, unsigned shift, std::size_t count)
{
  constexpr std::array<const char*, 4> names = {"synthetic", "key_point", "withheld", "overlap"};
  for (std::size_t i = 0; i < count; ++i) {
    columns.push_back({{names.at(i), ScalarType::uint8}, dimension, shift + static_cast<unsigned>(i), 1});
  }
}

/** All but the mark of points without coordinates. */
std::vector<Column> make_columns(const pdal::PointLayout& layout, bool is_las)
{
  using pdal::Dimension::Id;
  const bool is_legacy = is_las && !layout.hasDim(Id::ScanChannel);  // point formats 0 to 5
  std::vector<Column> columns;
  for (const Id dimension : layout.dims()) {
    const std::string name = layout.dimName(dimension);
    const Column column = {{field_name(name), scalar_type(layout.dimType(dimension))}, dimension};
    if (name == "ClassFlags") {
      add_flags(columns, dimension, 0, 4);
    } else if (is_legacy && dimension == Id::Classification && layout.findDim("Synthetic") == Id::Unknown) {
      constexpr unsigned class_bits = 5;
      columns.push_back({column.field, dimension, 0, (1 << class_bits) - 1});
      add_flags(columns, dimension, class_bits, 3);
    } else if (is_legacy && dimension == Id::ScanAngleRank) {
      columns.push_back({{column.field.name, ScalarType::int8}, dimension});
    } else if (dimension != Id::Omit) {
      columns.push_back(column);
    }
  }
  return columns;
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

void copy_scalars(
    const pdal::PointView& view, const pdal::PointId* ids, std::size_t count, const Column& column, PointTable& block)
{
  const std::size_t offset = block.find(column.field.name)->offset;
  visit_scalar(column.field.type, [&](auto zero) {
    for (std::size_t i = 0; i < count; ++i) {
      auto scalar = view.getFieldAs<decltype(zero)>(column.dimension, ids[i]);
      if (column.mask != 0) {
        scalar = static_cast<decltype(zero)>(static_cast<int>(scalar) >> column.shift & column.mask);
      }
      std::memcpy(block.record(i) + offset, &scalar, sizeof scalar);
    }
  });
}

void hand_over(const pdal::PointView& view,
               const PointIds& ids,
               const std::vector<Column>& columns,
               PointTable& block,
               PointSink& sink)
{
  for (std::size_t begin = 0; begin < ids.size(); begin += block.size()) {
    const std::size_t count = std::min(block.size(), ids.size() - begin);
    for (const Column& column : columns) {
      copy_scalars(view, &ids[begin], count, column, block);
    }
    sink.add(block, count);
  }
}

/** What libE57 says by numbers and its own names, in words. */
std::string in_words(const std::string& text)
{
  static const std::regex numbered("readers.e57: ([0-9]+) : .*");
  std::smatch match;
  if (!std::regex_match(text, match, numbered) && text != "E57 exception") {
    return text;
  }
  const std::string number = match.empty() ? "" : match[1].str();
  return number == "12" || number == "13" ? "its description in XML is wrong"
         : number == "16"                 ? "a checksum is wrong"
                                          : "its structure is wrong";
}

/** In one line, and without the name of the file, which the caller puts before it. */
std::string shorten(std::string text, const std::string& path)
{
  std::replace(text.begin(), text.end(), '\n', ' ');
  text = in_words(text);
  boost::replace_all(text, path, "the file");
  return text;
}

void check_e57(const std::string& path)
{
  const ByteSource bytes = ByteSource::from_file(path);
  check_e57_points(E57File(bytes));
}

void read(const PdalSource& source, PointSink& sink)
{
  pdal::PipelineManager pipeline;
  pipeline.setLog(pdal::Log::makeLog("", "devnull"));  // what goes wrong is reported by the caller, in one line
  const bool is_las = source.driver == "readers.las";
  pdal::Options options;
  if (is_las) {
    options.add("use_eb_vlr", true);  // extra bytes before version 1.4 as well
    options.add("start", source.first);
  }
  const std::size_t announced =
      pipeline.makeReader(source.path, source.driver, options).preview().m_pointCount - source.first;
  if (!is_las) {
    check_e57(source.path);
  }
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
  const std::vector<Column> columns = make_columns(*pipeline.pointTable().layout(), is_las);
  std::vector<Field> fields;
  fields.reserve(columns.size());
  for (const Column& column : columns) {
    fields.push_back(column.field);
  }
  constexpr std::size_t block_rows = std::size_t{1} << 13;  // which stay in the cache
  PointTable block(fields, block_rows);
  sink.start(fields, found, found < size ? std::to_string(size - found) + " points without coordinates" : "");
  for (const auto& [view, ids] : parts) {
    hand_over(*view, ids, columns, block, sink);
  }
}

}  // namespace

void pcl_pds_recon_read_with_pdal(const PdalSource& source, PointSink& sink, std::string& complaint)
{
  try {
    read(source, sink);
  } catch (const InvalidInput& error) {
    complaint = error.what();
  } catch (const std::bad_alloc&) {
    complaint = "PDAL asks for more memory than there is; the file is damaged, or too large for this machine";
  } catch (const std::exception& error) {
    complaint = "PDAL cannot read it (" + shorten(error.what(), source.path) + "); copy it again or write it anew";
  }
}

}  // namespace pds
