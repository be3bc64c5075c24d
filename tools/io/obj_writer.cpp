// SPDX-License-Identifier: BSD-3-Clause
#include "io/obj_writer.h"

#include "io/ascii_writer.h"

#include <cstring>
#include <initializer_list>
#include <string>

namespace pds
{

namespace
{

void append_fields(AsciiWriter& writer,
                   const PointTable& points,
                   std::size_t row,
                   std::initializer_list<const char*> names)
{
  for (const char* name : names) {
    const Field& field = *points.find(name);
    visit_scalar(field.type, [&](auto scalar) {
      std::memcpy(&scalar, points.record(row) + field.offset, sizeof scalar);
      writer.append_number(scalar);
    });
  }
}

}  // namespace

void write_obj(AtomicFile& file, const PointTable& points, const Triangles& triangles, const Segments& segments)
{
  AsciiWriter writer(file);
  const std::optional<ScalarType> color_type = points.color_type();
  const double greatest_color = color_type == ScalarType::uint16 ? 65535 : 255;  // OBJ has colours in 0 ... 1
  for (std::size_t row = 0; row < points.size(); ++row) {
    writer.append("v");
    append_fields(writer, points, row, {"x", "y", "z"});
    if (color_type) {
      for (const char* channel : {"red", "green", "blue"}) {
        writer.append_number(points.value(row, *points.find(channel)) / greatest_color);
      }
    }
    writer.end_line();
  }
  for (std::size_t row = 0; row < points.size() && points.has_normals(); ++row) {
    writer.append("vn");
    append_fields(writer, points, row, {"nx", "ny", "nz"});
    writer.end_line();
  }
  for (const auto& triangle : triangles) {
    writer.append("f");
    for (const std::uint32_t vertex : triangle) {
      const std::string number = std::to_string(vertex + 1);  // OBJ counts from 1
      std::string corner = number;
      if (points.has_normals()) {
        corner.append("//").append(number);
      }
      writer.append(corner);
    }
    writer.end_line();
  }
  for (const auto& segment : segments) {
    writer.append("l");
    for (const std::uint32_t vertex : segment) {
      writer.append(std::to_string(vertex + 1));
    }
    writer.end_line();
  }
  writer.flush();
}

}  // namespace pds
