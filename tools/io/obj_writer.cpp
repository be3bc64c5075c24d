// SPDX-License-Identifier: BSD-3-Clause
#include "io/obj_writer.h"

#include "io/ascii_writer.h"
#include "io/colors.h"

#include <cstring>
#include <optional>
#include <string>

namespace pds
{

namespace
{

void append_fields(AsciiWriter& writer, const PointTable& points, std::size_t row, const FieldTriple& names)
{
  for (const char* name : names) {
    const Field& field = *points.find(name);
    visit_scalar(field.type, [&](auto scalar) {
      std::memcpy(&scalar, points.record(row) + field.offset, sizeof scalar);
      writer.append_number(scalar);
    });
  }
}

void append_vertices(AsciiWriter& writer, const PointTable& points)
{
  const std::optional<Colors> colors = points.color_type() ? std::optional<Colors>(points) : std::nullopt;
  for (std::size_t row = 0; row < points.size(); ++row) {
    writer.append("v");
    append_fields(writer, points, row, position_fields);
    if (colors) {
      for (const double channel : (*colors)[row]) {
        writer.append_number(channel);
      }
    }
    writer.end_line();
  }
}

void append_normals(AsciiWriter& writer, const PointTable& points)
{
  for (std::size_t row = 0; row < points.size(); ++row) {
    writer.append("vn");
    append_fields(writer, points, row, normal_fields);
    writer.end_line();
  }
}

/** Faces or lines; OBJ counts vertices from 1. */
template <typename Cells>
void append_cells(AsciiWriter& writer, const char* keyword, const Cells& cells, bool with_normals)
{
  for (const auto& cell : cells) {
    writer.append(keyword);
    for (const std::uint32_t vertex : cell) {
      const std::string number = std::to_string(vertex + 1);
      std::string corner = number;
      if (with_normals) {
        corner.append("//").append(number);
      }
      writer.append(corner);
    }
    writer.end_line();
  }
}

}  // namespace

void write_obj(AtomicFile& file, const PointTable& points, const Triangles& triangles, const Segments& segments)
{
  AsciiWriter writer(file);
  append_vertices(writer, points);
  if (points.has_normals()) {
    append_normals(writer, points);
  }
  append_cells(writer, "f", triangles, points.has_normals());
  append_cells(writer, "l", segments, false);
  writer.flush();
}

}  // namespace pds
