// SPDX-License-Identifier: BSD-3-Clause
#include "compare/outside.h"

#include <Eigen/Geometry>
#include <cmath>

namespace pds
{

Outside::Outside(const TriangleMesh& mesh)
    : mesh_(mesh),
      first_(coincident_vertices(mesh.vertices)),
      begin_(mesh.vertices.size() + 1),
      corner_(3 * mesh.faces.size())
{
  for (const Triangle& face : mesh.faces)
    for (const std::uint32_t vertex : face) ++begin_[first_[vertex] + 1];
  for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  for (std::uint32_t corner = 0; corner < corner_.size(); ++corner)
    corner_[next[first_[mesh.faces[corner / 3][corner % 3]]]++] = corner;
}

Eigen::Vector3d Outside::at_vertex(std::uint32_t vertex) const
{
  Eigen::Vector3d sum(0, 0, 0);
  for (std::size_t i = begin_[first_[vertex]]; i < begin_[first_[vertex] + 1]; ++i) {
    const Triangle& face = mesh_.faces[corner_[i] / 3];
    const Eigen::Vector3d& at = mesh_.vertices[face[corner_[i] % 3]];
    const Eigen::Vector3d right = mesh_.vertices[face[(corner_[i] + 1) % 3]] - at;
    const Eigen::Vector3d left = mesh_.vertices[face[(corner_[i] + 2) % 3]] - at;
    const Eigen::Vector3d normal = right.cross(left);
    sum += std::atan2(normal.norm(), right.dot(left)) * normal.stableNormalized();
  }
  return sum;
}

Eigen::Vector3d Outside::at_edge(std::uint32_t from, std::uint32_t to) const
{
  Eigen::Vector3d sum(0, 0, 0);
  for (std::size_t i = begin_[first_[from]]; i < begin_[first_[from] + 1]; ++i) {
    const Triangle& face = mesh_.faces[corner_[i] / 3];
    const bool has_edge =
        first_[face[0]] == first_[to] || first_[face[1]] == first_[to] || first_[face[2]] == first_[to];
    if (has_edge) sum += area_normal(mesh_, face).stableNormalized();
  }
  return sum;
}

Eigen::Vector3d Outside::direction(const SurfaceTree::Hit& hit) const
{
  const Triangle& face = mesh_.faces[hit.face];
  switch (hit.part) {
    case TrianglePart::corner_0:
      return at_vertex(face[0]);
    case TrianglePart::corner_1:
      return at_vertex(face[1]);
    case TrianglePart::corner_2:
      return at_vertex(face[2]);
    case TrianglePart::edge_01:
      return at_edge(face[0], face[1]);
    case TrianglePart::edge_12:
      return at_edge(face[1], face[2]);
    case TrianglePart::edge_20:
      return at_edge(face[2], face[0]);
    case TrianglePart::inside:
      break;
  }
  return area_normal(mesh_, face);
}

}  // namespace pds
