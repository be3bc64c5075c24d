// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_reader.h"

#include "io/ply_body.h"
#include "io/ply_header.h"

#include <pcl_pds_recon/options.h>

#include <cstring>
#include <utility>

namespace pds
{

namespace
{

/** A property of the file and where its scalar goes. */
struct Column
{
  ScalarType type;
  std::optional<ScalarType> list_size_type;
  const Field* target;  ///< nullptr for a list
};

template <typename Body>
void read_row(Body& body, const std::vector<Column>& columns, PointTable& table, std::size_t row)
{
  for (const Column& column : columns) {
    if (column.list_size_type) {
      skip_list(body, *column.list_size_type, column.type);
      continue;
    }
    visit_scalar(column.type, [&](auto zero) {
      const auto scalar = body.next(zero);
      if (column.type == column.target->type) {
        std::memcpy(table.record(row) + column.target->offset, &scalar, sizeof scalar);
      } else {
        table.set_value(row, *column.target, static_cast<double>(scalar));
      }
    });
  }
}

PointTable make_table(const PlyElement& vertex)
{
  std::vector<Field> fields;
  for (const PlyProperty& property : vertex.properties) {
    if (!property.list_size_type) {
      fields.push_back({property.name, property.type});
    }
  }
  return PointTable(std::move(fields));
}

template <typename Body>
PointTable read_vertices(Body body, const std::vector<PlyElement>& elements)
{
  auto vertex = elements.begin();
  while (vertex != elements.end() && vertex->name != "vertex") {
    skip_element(body, *vertex++);
  }
  if (vertex == elements.end()) {
    throw InvalidInput("the PLY file has no element 'vertex'; write the points as vertices");
  }
  PointTable table = make_table(*vertex);
  std::vector<Column> columns;
  std::size_t least_row_bytes = 0;
  for (const PlyProperty& property : vertex->properties) {
    const Field* target = property.list_size_type ? nullptr : table.find(property.name);
    columns.push_back({property.type, property.list_size_type, target});
    least_row_bytes += Body::least_bytes(property.list_size_type.value_or(property.type));
  }
  // Before the memory is asked for: a damaged header may announce any number of points.
  if (vertex->count > body.remaining() / least_row_bytes) {
    throw_truncated_ply();
  }
  table.resize(static_cast<std::size_t>(vertex->count));
  for (std::size_t row = 0; row < table.size(); ++row) {
    read_row(body, columns, table, row);
  }
  return table;
}

}  // namespace

PointTable read_ply(std::string_view file)
{
  const PlyHeader header = parse_ply_header(file);
  return visit_ply_body(header, file, [&header](auto body) { return read_vertices(std::move(body), header.elements); });
}

}  // namespace pds
