// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace pds
{

/** \brief Finds the normals of the vertices of an OBJ file, which has them in lines of their own, 'vn', and says in the
 * corners of its faces whose they are. */
class ObjNormals
{
 public:
  using Vector = std::array<double, 3>;

  /** \brief Takes a line 'vn x y z'. \throws InvalidInput naming the line */
  void add_normal(const std::vector<std::string_view>& words, std::size_t line_number);

  /** \brief Takes a line 'f 1//1 2//2 3//3'. \throws InvalidInput naming the line if it is wrong about normals */
  void add_face(const std::vector<std::string_view>& words, std::size_t vertices_so_far, std::size_t line_number);

  [[nodiscard]] bool empty() const { return normals_.empty(); }

  /** \brief A normal for each of \a count vertices: the one that all its corners name, or, if the corners name those of
   * their vertices' numbers or none, the one in the same place of the file. Empty if not each vertex has one. */
  [[nodiscard]] std::vector<Vector> of_vertices(std::size_t count) const;

 private:
  void name_normal(std::uint32_t vertex, std::uint32_t normal);

  std::vector<Vector> normals_;
  std::vector<std::uint32_t> normal_of_vertex_;  ///< as corners name them
  bool in_order_ = true;                         ///< no corner names a normal of another number than its vertex
  bool one_each_ = true;                         ///< no two corners name different normals for a vertex
};

}  // namespace pds
