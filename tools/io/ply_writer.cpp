// SPDX-License-Identifier: BSD-3-Clause
#include "io/ply_writer.h"

#include "io/ascii_writer.h"

#include <boost/endian/conversion.hpp>
#include <cstring>
#include <string>

namespace pds
{

namespace
{

static_assert(boost::endian::order::native == boost::endian::order::little,
              "records are written as they lie in memory");

std::string header(const PointTable& points, std::size_t face_count, bool ascii)
{
  std::string text = std::string("ply\nformat ") + (ascii ? "ascii" : "binary_little_endian") + " 1.0\n";
  text += "element vertex " + std::to_string(points.size()) + "\n";
  for (const Field& field : points.fields()) {
    text += std::string("property ") + ply_name(field.type) + " " + field.name + "\n";
  }
  if (face_count > 0) {
    text += "element face " + std::to_string(face_count) + "\nproperty list uchar int vertex_indices\n";
  }
  return text + "end_header\n";
}

void write_ascii_body(AtomicFile& file, const PointTable& points, const Triangles& triangles)
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
  writer.flush();
}

void write_binary_body(AtomicFile& file, const PointTable& points, const Triangles& triangles)
{
  file.write(points.record(0), points.size() * points.record_bytes());
  for (const auto& triangle : triangles) {
    constexpr unsigned char side_count = 3;
    file.write(&side_count, sizeof side_count);
    file.write(triangle.data(), sizeof triangle);
  }
}

}  // namespace

void write_ply(AtomicFile& file, const PointTable& points, const Triangles& triangles, bool ascii)
{
  const std::string text = header(points, triangles.size(), ascii);
  file.write(text.data(), text.size());
  (ascii ? write_ascii_body : write_binary_body)(file, points, triangles);
}

}  // namespace pds
