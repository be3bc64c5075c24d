// SPDX-License-Identifier: BSD-3-Clause
#include "compare/face_readers.h"
#include "io/ply_body.h"
#include "io/ply_header.h"

#include <utility>

namespace pds
{

namespace
{

template <typename Body>
std::uint32_t read_index(Body& body, ScalarType type)
{
  const double index = visit_scalar(type, [&body](auto zero) { return static_cast<double>(body.next(zero)); });
  if (!(index >= 0 && index < std::numeric_limits<std::uint32_t>::max()) || std::trunc(index) != index) {
    throw InvalidInput("a face names a vertex with an impossible number: the file is damaged; write it again");
  }
  return static_cast<std::uint32_t>(index);
}

template <typename Body>
void read_corners(Body& body, const PlyProperty& property, std::vector<std::uint32_t>& corners)
{
  const std::uint32_t size = read_list_size(body, *property.list_size_type);
  // Before the memory is asked for: a damaged list may announce any number of corners.
  if (size > body.remaining() / Body::least_bytes(property.type)) {
    throw_truncated_ply();
  }
  corners.resize(size);
  for (std::uint32_t& corner : corners) {
    corner = read_index(body, property.type);
  }
}

template <typename Body>
Triangles read_faces(Body body, const std::vector<PlyElement>& elements)
{
  auto face = elements.begin();
  while (face != elements.end() && face->name != "face") {
    skip_element(body, *face++);
  }
  Triangles triangles;
  if (face == elements.end() || face->properties.empty()) {
    return triangles;
  }
  if (std::none_of(face->properties.begin(), face->properties.end(),
                   [](const PlyProperty& property) { return property.is_corner_list(); })) {
    throw InvalidInput("its faces have no list 'vertex_indices'; write the mesh again with one");
  }
  std::vector<std::uint32_t> corners;
  for (std::uint64_t row = 0; row < face->count; ++row) {
    for (const PlyProperty& property : face->properties) {
      if (property.is_corner_list()) {
        read_corners(body, property, corners);
        add_polygon(corners, triangles);
      } else if (property.list_size_type) {
        skip_list(body, *property.list_size_type, property.type);
      } else {
        body.skip(property.type, 1);
      }
    }
  }
  return triangles;
}

}  // namespace

Triangles read_ply_faces(std::string_view file)
{
  const PlyHeader header = parse_ply_header(file);
  return visit_ply_body(header, file, [&header](auto body) { return read_faces(std::move(body), header.elements); });
}

}  // namespace pds
