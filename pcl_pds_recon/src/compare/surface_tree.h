// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "compare/closest_point.h"

#include <pcl_pds_recon/triangle_mesh.h>
#include <functional>
#include <memory>

namespace pds
{

/** \brief Finds the place of a surface that is nearest to a point: a bounding volume hierarchy of Embree's over the
 * faces of a mesh or the points of a cloud.
 *
 * Embree's boxes are in single precision and only sort out what cannot be nearest, with a margin for their rounding;
 * distances are computed in double precision, and of equal ones the lowest number wins. The result therefore does not
 * depend on the shape of the tree. Queries may come from several threads.
 */
class SurfaceTree
{
 public:
  static constexpr std::uint32_t none = 0xffffffffU;

  /** \brief The nearest place. */
  struct Hit
  {
    std::uint32_t face = none;  ///< of a cloud: the point's index
    Eigen::Vector3d point{0, 0, 0};
    TrianglePart part = TrianglePart::inside;  ///< of a cloud: corner_0
    double squared_distance = 0;
  };

  /** \param surface must outlive this object; a cloud if it has no faces. Faces without area and points that are not
   * finite are passed over; something must be left
   * \param threads that build the tree
   */
  SurfaceTree(const TriangleMesh& surface, unsigned threads);
  ~SurfaceTree();
  SurfaceTree(const SurfaceTree&) = delete;
  SurfaceTree& operator=(const SurfaceTree&) = delete;

  /** \brief The place nearest to \a p.
   * \param near a face (or point) that is probably near, such as the last answer for a point close by; it saves time
   * \throws InvalidInput if \a p is so far away that distances overflow
   */
  [[nodiscard]] Hit closest(const Eigen::Vector3d& p, std::uint32_t near = none) const;

  /** \brief Number of pairs of faces whose boxes meet and of which \a test is true. It is called from several threads.
   */
  [[nodiscard]] std::size_t count_pairs(const std::function<bool(std::uint32_t, std::uint32_t)>& test) const;

  /** \brief Length of the diagonal of the surface's bounding box. */
  [[nodiscard]] double diagonal() const;

 private:
  struct Scene;
  std::unique_ptr<Scene> scene_;
};

}  // namespace pds
