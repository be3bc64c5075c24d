// SPDX-License-Identifier: BSD-3-Clause
#include "html/mesh_measures.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

namespace pds
{

std::vector<double> edge_lengths(const TriangleMesh& mesh)
{
  std::vector<std::pair<std::uint32_t, std::uint32_t>> edges;
  edges.reserve(3 * mesh.faces.size());
  for (const Triangle& face : mesh.faces) {
    for (std::size_t i = 0; i < face.size(); ++i) {
      edges.push_back(std::minmax({face[i], face[(i + 1) % 3]}));
    }
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  std::vector<double> lengths;
  lengths.reserve(edges.size());
  for (const auto& [a, b] : edges) {
    lengths.push_back((mesh.vertices[a] - mesh.vertices[b]).norm());
  }
  return lengths;
}

std::vector<double> smallest_angles(const TriangleMesh& mesh)
{
  constexpr double degrees = 180 / 3.14159265358979323846;
  std::vector<double> angles;
  angles.reserve(mesh.faces.size());
  for (const Triangle& face : mesh.faces) {
    double smallest = 60;
    for (std::size_t i = 0; i < face.size(); ++i) {
      const Eigen::Vector3d& corner = mesh.vertices[face[i]];
      const Eigen::Vector3d a = mesh.vertices[face[(i + 1) % 3]] - corner;
      const Eigen::Vector3d b = mesh.vertices[face[(i + 2) % 3]] - corner;
      smallest = std::min(smallest, std::atan2(a.cross(b).norm(), a.dot(b)) * degrees);
    }
    angles.push_back(smallest);
  }
  return angles;
}

}  // namespace pds
