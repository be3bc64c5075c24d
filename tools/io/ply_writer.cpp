// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_writer.h"

#include "io/ascii_writer.h"

#include <algorithm>
#include <boost/endian/conversion.hpp>
#include <cstring>
#include <string>

namespace pds
{

namespace
{

static_assert(boost::endian::order::native == boost::endian::order::little,
              "records are written as they lie in memory");

bool is_wide_integer(const Field& field) { return field.type == ScalarType::int64 || field.type == ScalarType::uint64; }

/** The same points with doubles in place of wide integers, which PLY does not have. */
PointTable without_wide_integers(const PointTable& points)
{
  std::vector<Field> doubles;
  for (const Field& field : points.fields()) {
    if (is_wide_integer(field)) {
      doubles.push_back({field.name, ScalarType::float64});
    }
  }
  PointTable table = points.with_fields(doubles, Parallel(1));
  for (const Field& field : doubles) {
    for (std::size_t row = 0; row < table.size(); ++row) {
      table.set_value(row, *table.find(field.name), points.value(row, *points.find(field.name)));
    }
  }
  return table;
}

std::string header(const PointTable& points, std::size_t face_count, std::size_t segment_count, bool ascii)
{
  std::string text = std::string("ply\nformat ") + (ascii ? "ascii" : "binary_little_endian") + " 1.0\n";
  text += "element vertex " + std::to_string(points.size()) + "\n";
  for (const Field& field : points.fields()) {
    text += std::string("property ") + ply_name(field.type) + " " + field.name + "\n";
  }
  if (face_count > 0) {
    text += "element face " + std::to_string(face_count) + "\nproperty list uchar int vertex_indices\n";
  }
  if (segment_count > 0) {
    text += "element edge " + std::to_string(segment_count) + "\nproperty int vertex1\nproperty int vertex2\n";
  }
  return text + "end_header\n";
}

void write_ascii_body(AtomicFile& file, const PointTable& points, const Triangles& triangles, const Segments& segments)
{
  AsciiWriter writer(file);
  for (std::size_t row = 0; row < points.size(); ++row) {
    for (const Field& field : points.fields()) {
      visit_scalar(field.type, [&](auto scalar) {
        std::memcpy(&scalar, points.record(row) + field.offset, sizeof scalar);
        writer.append_number(scalar);
      });
    }
    writer.end_line();
  }
  for (const auto& triangle : triangles) {
    writer.append_number(3);
    for (const std::uint32_t vertex : triangle) {
      writer.append_number(vertex);
    }
    writer.end_line();
  }
  for (const auto& segment : segments) {
    writer.append_number(segment[0]);
    writer.append_number(segment[1]);
    writer.end_line();
  }
  writer.flush();
}

void write_binary_body(AtomicFile& file, const PointTable& points, const Triangles& triangles, const Segments& segments)
{
  file.write(points.record(0), points.size() * points.record_bytes());
  constexpr std::size_t face_bytes = 1 + sizeof triangles.front();
  std::string faces(triangles.size() * face_bytes, '\3');  // each starts with its number of corners
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    std::memcpy(faces.data() + i * face_bytes + 1, &triangles[i], sizeof triangles[i]);
  }
  file.write(faces.data(), faces.size());
  file.write(segments.data(), segments.size() * sizeof(Segments::value_type));
}

}  // namespace

void write_ply(
    AtomicFile& file, const PointTable& points, const Triangles& triangles, bool ascii, const Segments& segments)
{
  if (std::any_of(points.fields().begin(), points.fields().end(), is_wide_integer)) {
    write_ply(file, without_wide_integers(points), triangles, ascii, segments);
    return;
  }
  const std::string text = header(points, triangles.size(), segments.size(), ascii);
  file.write(text.data(), text.size());
  (ascii ? write_ascii_body : write_binary_body)(file, points, triangles, segments);
}

}  // namespace pds
