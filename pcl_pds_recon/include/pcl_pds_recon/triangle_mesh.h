// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include <pcl_pds_recon/triangle_complex.h>

namespace pds
{

/** \brief A triangle mesh, whoever made it, or a cloud: a mesh without faces. */
struct TriangleMesh
{
  std::vector<Eigen::Vector3d> vertices;  ///< coordinates
  std::vector<Triangle> faces;            ///< vertices of each face, counter-clockwise from outside
  std::vector<Eigen::Vector3d> normals;   ///< of a cloud's points; unit, or zero where unknown; empty if it has none
};

/** \brief Checks that every face names vertices that are there and have finite coordinates.
 * \throws InvalidInput naming the first that does not
 */
void validate(const TriangleMesh& mesh);

/** \brief Vector whose direction is the face's normal and whose length is twice its area. */
[[nodiscard]] Eigen::Vector3d area_normal(const TriangleMesh& mesh, const Triangle& face);

/** \brief For each vertex the first of those with the same coordinates. O(n log n). */
[[nodiscard]] std::vector<std::uint32_t> coincident_vertices(const std::vector<Eigen::Vector3d>& vertices);

/** \brief Lets all faces name the first of coincident vertices; the others are left without a face. */
void weld(TriangleMesh& mesh);

}  // namespace pds
