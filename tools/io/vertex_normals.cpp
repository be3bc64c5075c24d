// SPDX-License-Identifier: BSD-3-Clause
#include "io/vertex_normals.h"

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cmath>
#include <cstring>
#include <vector>

namespace pds
{

PointTable with_vertex_normals(const PointTable& vertices, const Triangles& triangles)
{
  const Vector3View positions = vertices.view().positions;
  std::vector<Eigen::Vector3d> normals(vertices.size(), Eigen::Vector3d::Zero());
  for (const auto& triangle : triangles) {
    for (std::size_t i = 0; i < triangle.size(); ++i) {
      const Eigen::Vector3d corner = positions[triangle[i]];
      const Eigen::Vector3d to_next = positions[triangle[(i + 1) % 3]] - corner;
      const Eigen::Vector3d to_last = positions[triangle[(i + 2) % 3]] - corner;
      const Eigen::Vector3d area = to_next.cross(to_last);
      const double angle = std::atan2(area.norm(), to_next.dot(to_last));
      normals[triangle[i]] += angle * area.stableNormalized();
    }
  }
  PointTable table = vertices.with_fields(
      {{"nx", ScalarType::float32}, {"ny", ScalarType::float32}, {"nz", ScalarType::float32}}, Parallel(1));
  const std::size_t offset = table.find("nx")->offset;
  for (std::size_t row = 0; row < table.size(); ++row) {
    const Eigen::Vector3f normal = normals[row].stableNormalized().cast<float>();
    std::memcpy(table.record(row) + offset, normal.data(), 3 * sizeof(float));
  }
  return table;
}

}  // namespace pds
