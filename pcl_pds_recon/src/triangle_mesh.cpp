// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/options.h>
#include <pcl_pds_recon/triangle_mesh.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>

namespace pds
{

void validate(const TriangleMesh& mesh)
{
  for (std::size_t f = 0; f < mesh.faces.size(); ++f)
    for (const std::uint32_t vertex : mesh.faces[f]) {
      if (vertex >= mesh.vertices.size())
        throw InvalidInput("face " + std::to_string(f) + " names vertex " + std::to_string(vertex) + " of " +
                           std::to_string(mesh.vertices.size()) + ", counted from 0; write the mesh again");
      if (!mesh.vertices[vertex].allFinite())
        throw InvalidInput("vertex " + std::to_string(vertex) + " has a face but no finite coordinates; remove it");
    }
}

Eigen::Vector3d area_normal(const TriangleMesh& mesh, const Triangle& face)
{
  const Eigen::Vector3d& a = mesh.vertices[face[0]];
  return (mesh.vertices[face[1]] - a).cross(mesh.vertices[face[2]] - a);
}

std::vector<std::uint32_t> coincident_vertices(const std::vector<Eigen::Vector3d>& vertices)
{
  std::vector<std::uint32_t> order(vertices.size());
  std::iota(order.begin(), order.end(), 0U);
  const auto key = [&vertices](std::uint32_t i) {
    const Eigen::Vector3d& p = vertices[i];
    return std::make_tuple(p.x(), p.y(), p.z(), i);
  };
  std::sort(order.begin(), order.end(), [&key](std::uint32_t i, std::uint32_t j) { return key(i) < key(j); });
  std::vector<std::uint32_t> first(vertices.size());
  for (std::size_t at = 0; at < order.size(); ++at) {
    const bool repeats = at > 0 && vertices[order[at]] == vertices[order[at - 1]];
    first[order[at]] = repeats ? first[order[at - 1]] : order[at];
  }
  return first;
}

void weld(TriangleMesh& mesh)
{
  const std::vector<std::uint32_t> first = coincident_vertices(mesh.vertices);
  for (Triangle& face : mesh.faces)
    for (std::uint32_t& vertex : face) vertex = first[vertex];
}

}  // namespace pds
