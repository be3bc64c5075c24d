// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pds_test
{

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

/** \brief What a mesh is, counted without the library's help, by maps and sets and in the plainest way. */
struct MeshFacts
{
  std::size_t vertices = 0;  ///< named by a face
  std::size_t faces = 0;
  std::size_t edges = 0;
  std::size_t components = 0;
  std::size_t largest_component = 0;  ///< faces
  std::size_t boundary_loops = 0;
  std::size_t nonmanifold_edges = 0;
  std::size_t nonmanifold_vertices = 0;
  std::size_t inconsistent_edges = 0;
  std::size_t duplicate_faces = 0;
  std::size_t degenerate_faces = 0;  ///< a repeated corner, or a height below 1e-12 of the longest edge
  std::size_t folded_edges = 0;      ///< the two faces enclose less than 30 degrees
  double longest_edge = 0;
  double area = 0;
  double volume = 0;  ///< enclosed, positive if the faces are counter-clockwise from outside

  [[nodiscard]] long long euler() const
  {
    return static_cast<long long>(vertices) - static_cast<long long>(edges) + static_cast<long long>(faces);
  }
};

[[nodiscard]] MeshFacts examine(const Triangles& triangles, const std::vector<Eigen::Vector3d>& position);

/** \brief Edges that pierce a face with which they share no corner. O(faces^2). */
[[nodiscard]] std::size_t count_piercing_edges(const Triangles& triangles,
                                               const std::vector<Eigen::Vector3d>& position);

}  // namespace pds_test
