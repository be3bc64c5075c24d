// SPDX-License-Identifier: BSD-3-Clause
#include "io/stl_writer.h"

#include "io/ascii_writer.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstring>

namespace pds
{

namespace
{

/** Unit normal and three corners. */
using Facet = std::array<Eigen::Vector3f, 4>;

Facet make_facet(const Vector3View& positions, const std::array<std::uint32_t, 3>& triangle)
{
  const Eigen::Vector3d a = positions[triangle[0]];
  const Eigen::Vector3d b = positions[triangle[1]];
  const Eigen::Vector3d c = positions[triangle[2]];
  const Eigen::Vector3d normal = (b - a).cross(c - a).normalized();
  return {normal.cast<float>(), a.cast<float>(), b.cast<float>(), c.cast<float>()};
}

void append_vector(AsciiWriter& writer, const Eigen::Vector3f& vector)
{
  for (const float coordinate : vector) {
    writer.append_number(coordinate);
  }
  writer.end_line();
}

void append_line(AsciiWriter& writer, std::string_view line)
{
  writer.append(line);
  writer.end_line();
}

void write_ascii(AtomicFile& file, const Vector3View& positions, const Triangles& triangles)
{
  AsciiWriter writer(file);
  append_line(writer, "solid pcl_pds_recon");
  for (const auto& triangle : triangles) {
    const Facet facet = make_facet(positions, triangle);
    writer.append("facet normal");
    append_vector(writer, facet[0]);
    append_line(writer, "outer loop");
    for (std::size_t corner = 1; corner < facet.size(); ++corner) {
      writer.append("vertex");
      append_vector(writer, facet[corner]);
    }
    append_line(writer, "endloop");
    append_line(writer, "endfacet");
  }
  append_line(writer, "endsolid pcl_pds_recon");
  writer.flush();
}

void write_binary(AtomicFile& file, const Vector3View& positions, const Triangles& triangles)
{
  constexpr std::array<char, 80> title = {"binary STL of pcl_pds_recon"};  // must not start with "solid"
  const auto count = static_cast<std::uint32_t>(triangles.size());
  file.write(title.data(), title.size());
  file.write(&count, sizeof count);
  for (const auto& triangle : triangles) {
    constexpr std::uint16_t attribute_bytes = 0;
    for (const Eigen::Vector3f& vector : make_facet(positions, triangle)) {
      file.write(vector.data(), 3 * sizeof(float));
    }
    file.write(&attribute_bytes, sizeof attribute_bytes);
  }
}

}  // namespace

void write_stl(AtomicFile& file, const PointTable& points, const Triangles& triangles, bool ascii)
{
  (ascii ? write_ascii : write_binary)(file, points.view().positions, triangles);
}

}  // namespace pds
