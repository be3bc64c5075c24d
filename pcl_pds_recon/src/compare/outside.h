// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/surface_tree.h"

namespace pds
{

/** \brief Says which side of a mesh a point is on, by the angle-weighted pseudonormal of the nearest face, edge or
 * vertex: the only normal that is right for all three (Baerentzen and Aanaes 2005). Coincident vertices count as one.
 */
class Outside
{
 public:
  /** \param mesh must outlive this object */
  explicit Outside(const TriangleMesh& mesh);

  /** \brief Vector that points to the outside at the place \a hit of the mesh; not of unit length. */
  [[nodiscard]] Eigen::Vector3d direction(const SurfaceTree::Hit& hit) const;

  [[nodiscard]] Eigen::Vector3d at_vertex(std::uint32_t vertex) const;  ///< likewise

 private:
  [[nodiscard]] Eigen::Vector3d at_edge(std::uint32_t from, std::uint32_t to) const;

  const TriangleMesh& mesh_;
  std::vector<std::uint32_t> first_;   ///< by vertex: the first at the same place
  std::vector<std::size_t> begin_;     ///< by vertex: begin of its corners; size vertices + 1
  std::vector<std::uint32_t> corner_;  ///< 3 times the face, plus the place in it
};

}  // namespace pds
