// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/triangle_mesh.h>

#include <algorithm>
#include <map>
#include <utility>

namespace pds
{

/** \brief Sphere around the origin: an octahedron whose faces are split into four \a splits times, facing outward. */
inline TriangleMesh make_sphere(double radius, int splits)
{
  TriangleMesh mesh;
  mesh.vertices = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  mesh.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
  for (int split = 0; split < splits; ++split) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
    const auto between = [&](std::uint32_t a, std::uint32_t b) {
      const auto [at, is_new] = middle.emplace(std::minmax(a, b), static_cast<std::uint32_t>(mesh.vertices.size()));
      if (is_new) mesh.vertices.emplace_back((mesh.vertices[a] + mesh.vertices[b]).normalized());
      return at->second;
    };
    std::vector<Triangle> faces;
    for (const auto& [a, b, c] : mesh.faces) {
      const std::uint32_t ab = between(a, b);
      const std::uint32_t bc = between(b, c);
      const std::uint32_t ca = between(c, a);
      faces.insert(faces.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
    }
    mesh.faces = faces;
  }
  for (Eigen::Vector3d& p : mesh.vertices) p *= radius;
  return mesh;
}

/** \brief The unit square at height z, facing up, of cells x cells squares cut in two. */
inline TriangleMesh make_plane(double z, std::uint32_t cells)
{
  TriangleMesh mesh;
  for (std::uint32_t j = 0; j <= cells; ++j)
    for (std::uint32_t i = 0; i <= cells; ++i) mesh.vertices.emplace_back(1.0 * i / cells, 1.0 * j / cells, z);
  for (std::uint32_t j = 0; j < cells; ++j)
    for (std::uint32_t i = 0; i < cells; ++i) {
      const std::uint32_t a = j * (cells + 1) + i;
      const std::uint32_t b = a + cells + 1;
      mesh.faces.push_back({a, a + 1, b + 1});
      mesh.faces.push_back({a, b + 1, b});
    }
  return mesh;
}

/** \brief Points in the middle of a lattice's cells over the unit square, at height z. */
inline TriangleMesh make_lattice_cloud(double z, std::uint32_t cells)
{
  TriangleMesh cloud;
  for (std::uint32_t j = 0; j < cells; ++j)
    for (std::uint32_t i = 0; i < cells; ++i) cloud.vertices.emplace_back((i + 0.5) / cells, (j + 0.5) / cells, z);
  return cloud;
}

/** \brief Adds all of \a part, which may be a copy of it, to \a mesh. */
inline void append(TriangleMesh& mesh, TriangleMesh part)
{
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& [a, b, c] : part.faces) mesh.faces.push_back({first + a, first + b, first + c});
}

}  // namespace pds
