// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/triangle_complex.h>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pds
{

/** \brief Which faces of an oriented manifold mesh are at each vertex, and which ones are beside each face. */
class MeshFans
{
 public:
  /** \param spare how many more faces each vertex may get by flips */
  MeshFans(const std::vector<Triangle>& triangles,
           std::size_t vertex_count,
           const Parallel& parallel,
           std::size_t spare = 0);

  /** \brief Replaces the faces (a, b, c) and (b, a, d), in whatever rotation, by (c, d, b) and (d, c, a).
   * \param face their numbers, which the new ones take over
   * \param corner a, b, c, d
   * \param triangles those that the fans were made of, as flips have changed them */
  void flip(const std::array<std::uint32_t, 2>& face,
            const std::array<std::uint32_t, 4>& corner,
            std::vector<Triangle>& triangles);

  [[nodiscard]] const std::uint32_t* begin(std::size_t vertex) const { return face_.data() + begin_[vertex]; }
  [[nodiscard]] const std::uint32_t* end(std::size_t vertex) const { return face_.data() + end_[vertex]; }
  [[nodiscard]] bool empty(std::size_t vertex) const { return begin_[vertex] == end_[vertex]; }
  /** \brief The face beyond the side from corner \a side to the next, or TriangleComplex::no_face. */
  [[nodiscard]] std::uint32_t across(std::size_t face, std::size_t side) const { return across_[face][side]; }

  static std::size_t corner_of(const Triangle& t, std::uint32_t vertex)
  {
    return t[0] == vertex ? 0 : t[1] == vertex ? 1 : 2;
  }

 private:
  void insert(std::uint32_t vertex, std::uint32_t face);
  void erase(std::uint32_t vertex, std::uint32_t face);

  std::vector<std::size_t> begin_;   ///< by vertex: its first place in face_
  std::vector<std::size_t> end_;     ///< by vertex: behind its last place
  std::vector<std::uint32_t> face_;  ///< ascending for each vertex
  std::vector<std::array<std::uint32_t, 3>> across_;
};

}  // namespace pds
