// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_reader.h"

#include "io/ply_body.h"
#include "io/ply_byte_order.h"
#include "io/ply_header.h"
#include "io/record_reader.h"
#include "io/sentence_list.h"

#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <boost/algorithm/string/join.hpp>
#include <boost/endian/conversion.hpp>
#include <cstring>
#include <numeric>
#include <utility>

namespace pds
{

namespace
{

/** A property of the file and where its scalar goes. */
struct VertexProperty
{
  ScalarType type;
  std::optional<ScalarType> list_size_type;
  const Field* field;  ///< nullptr for a list
};

template <typename Body>
void read_row(Body& body, const std::vector<VertexProperty>& properties, PointTable& table, std::size_t row)
{
  for (const VertexProperty& property : properties) {
    if (property.list_size_type) {
      skip_list(body, *property.list_size_type, property.type);
      continue;
    }
    visit_scalar(property.type, [&](auto zero) {
      const auto scalar = body.next(zero);
      if (property.type == property.field->type) {
        std::memcpy(table.record(row) + property.field->offset, &scalar, sizeof scalar);
      } else {
        table.set_value(row, *property.field, static_cast<double>(scalar));
      }
    });
  }
}

std::vector<Column> scalar_columns(const PlyElement& element)
{
  std::vector<Column> columns;
  std::size_t offset = 0;
  for (const PlyProperty& property : element.properties) {
    if (!property.list_size_type) {
      columns.push_back({property.name, property.type, offset});
      offset += size_of(property.type);
    }
  }
  return columns;
}

/** Passes over faces. After a wrong number of vertices they begin in the middle of something, and seem to have fewer
 * corners than faces do. */
template <typename Body>
void skip_faces(Body& body, const PlyElement& face)
{
  constexpr std::uint32_t least_corners = 3;
  for (std::uint64_t row = 0; row < face.count; ++row) {
    for (const PlyProperty& property : face.properties) {
      const std::uint64_t size = property.list_size_type ? read_list_size(body, *property.list_size_type) : 1;
      if (property.is_corner_list() && size < least_corners) {
        throw InvalidInput(
            "has a face of fewer than three corners: the number of vertices in its header is wrong, or the "
            "file damaged; write it again");
      }
      body.skip(property.type, size);
    }
  }
}

/** Passes over what follows the vertices, such as faces: only there it shows whether their number is right. */
template <typename Body>
void check_rest(Body& body, const std::vector<PlyElement>& elements, std::size_t vertex_index, std::size_t vertex_bytes)
{
  std::for_each(elements.begin() + static_cast<std::ptrdiff_t>(vertex_index) + 1, elements.end(),
                [&body](const PlyElement& element) {
                  element.name == "face" ? skip_faces(body, element) : skip_element(body, element);
                });
  if (body.has_more(std::max<std::size_t>(1, vertex_bytes))) {
    throw_data_after_points();
  }
}

/** What is there beside the scalars of the vertices, as the end of a sentence. */
std::string what_is_not_read(const std::vector<PlyElement>& elements, std::size_t vertex_index)
{
  std::vector<std::string> lists;
  for (const PlyProperty& property : elements[vertex_index].properties) {
    if (property.list_size_type) {
      lists.push_back(property.name);
    }
  }
  std::vector<std::string> others;
  for (std::size_t i = 0; i < elements.size(); ++i) {
    if (i != vertex_index && elements[i].count > 0) {
      others.push_back(elements[i].name);
    }
  }
  std::vector<std::string> items;
  if (!lists.empty()) {
    items.push_back("the list properties " + boost::algorithm::join(lists, " "));
  }
  if (!others.empty()) {
    items.push_back("the rows of " + boost::algorithm::join(others, " "));
  }
  return sentence_list(items);
}

/** Scalar by scalar: for text, and for lists, whose sizes are known only when they are met. */
template <typename Body>
PointTable read_vertices(Body body, const PlyHeader& header, std::size_t vertex_index)
{
  const std::vector<PlyElement>& elements = header.elements;
  std::for_each_n(elements.begin(), vertex_index, [&body](const PlyElement& element) { skip_element(body, element); });
  const PlyElement& vertex = elements[vertex_index];
  std::size_t least_row_bytes = 0;
  for (const PlyProperty& property : vertex.properties) {
    least_row_bytes += Body::least_bytes(property.list_size_type.value_or(property.type));
  }
  // Before the memory is asked for: a damaged header may announce any number of points.
  if (vertex.count > body.remaining() / std::max<std::size_t>(1, least_row_bytes)) {
    throw_truncated_ply();
  }
  PointTable table = make_table(scalar_columns(vertex), static_cast<std::size_t>(vertex.count));
  std::vector<VertexProperty> targets;
  for (const PlyProperty& property : vertex.properties) {
    const Field* field = property.list_size_type ? nullptr : table.find(property.name);
    targets.push_back({property.type, property.list_size_type, field});
  }
  for (std::size_t row = 0; row < table.size(); ++row) {
    read_row(body, targets, table, row);
  }
  check_ply_byte_order(header, vertex, table);
  check_rest(body, elements, vertex_index, least_row_bytes);
  table.not_read = what_is_not_read(elements, vertex_index);
  return table;
}

bool has_list(const PlyElement& element)
{
  return std::any_of(element.properties.begin(), element.properties.end(),
                     [](const PlyProperty& property) { return property.list_size_type.has_value(); });
}

std::size_t row_bytes(const PlyElement& element)
{
  return std::accumulate(element.properties.begin(), element.properties.end(), std::size_t{0},
                         [](std::size_t bytes, const PlyProperty& property) { return bytes + size_of(property.type); });
}

boost::endian::order byte_order(const PlyHeader& header)
{
  return header.encoding == PlyEncoding::big_endian ? boost::endian::order::big : boost::endian::order::little;
}

/** Records of one size, so that all of them can be found at once. */
PointTable read_binary_records(const ByteSource& source,
                               const PlyHeader& header,
                               std::size_t vertex_index,
                               const Parallel& parallel)
{
  RecordLayout layout;
  layout.begin = header.bytes;
  layout.order = byte_order(header);
  for (std::size_t i = 0; i <= vertex_index; ++i) {
    const PlyElement& element = header.elements[i];
    layout.record_bytes = row_bytes(element);
    layout.count = element.count;
    const std::size_t remaining = source.size() - layout.begin;
    if (layout.record_bytes > 0 && layout.count > remaining / layout.record_bytes) {
      throw_truncated_ply();
    }
    if (i < vertex_index) {
      layout.begin += static_cast<std::size_t>(layout.count) * layout.record_bytes;
    }
  }
  layout.columns = scalar_columns(header.elements[vertex_index]);
  PointTable table = read_records(source, layout, parallel);
  check_ply_byte_order(header, header.elements[vertex_index], table);
  const std::size_t end = layout.begin + static_cast<std::size_t>(layout.count) * layout.record_bytes;
  std::string rest(source.size() - end, '\0');
  source.read(end, rest.data(), rest.size());
  BinaryBody body(rest, layout.order);
  check_rest(body, header.elements, vertex_index, layout.record_bytes);
  table.not_read = what_is_not_read(header.elements, vertex_index);
  return table;
}

}  // namespace

PointTable read_ply(const ByteSource& source, const Parallel& parallel)
{
  const PlyHeader header = parse_ply_header(source.head_through_line("end_header"));
  const std::vector<PlyElement>& elements = header.elements;
  const auto vertex = std::find_if(elements.begin(), elements.end(),
                                   [](const PlyElement& element) { return element.name == "vertex"; });
  if (vertex == elements.end()) {
    throw InvalidInput("the PLY file has no element 'vertex'; write the points as vertices");
  }
  const auto vertex_index = static_cast<std::size_t>(vertex - elements.begin());
  if (header.encoding != PlyEncoding::ascii && std::none_of(elements.begin(), vertex + 1, has_list)) {
    return read_binary_records(source, header, vertex_index, parallel);
  }
  const std::string file = source.all();
  return visit_ply_body(header, file, [&](auto body) { return read_vertices(body, header, vertex_index); });
}

}  // namespace pds
