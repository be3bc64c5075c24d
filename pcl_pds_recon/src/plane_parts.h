// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>

#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/point_array.h>
#include "cloud_frame.h"
#include "voxel_runs.h"

namespace pds
{

/** \brief The parts of a surface in cubes about as large as a disk, and which of them are in the midst of a plane part.
 *
 * O(n) for points along a Morton curve through their box, since the cubes are cells of this curve.
 */
class PlaneParts
{
 public:
  /** \param position of the points, of which those from \a begin to \a end are looked at; the others are as if not
   * there \param bounds of all points \param radius of the disks; a cube's side is 0.7 to 1.4 of it \param thickest
   * standard deviation of points from their plane, where that is one */
  PlaneParts(const PointArray<Eigen::Vector3f>& position,
             std::size_t begin,
             std::size_t end,
             const Bounds& bounds,
             double radius,
             double thickest,
             const Parallel& parallel);

  [[nodiscard]] std::size_t cubes() const { return cubes_.voxels(); }
  /** \brief Mean of a cube's points. */
  [[nodiscard]] const Eigen::Vector3f& middle(std::size_t cube) const { return pieces_[cube].middle; }
  /** \brief Unit normal of their plane, if they have one. */
  [[nodiscard]] const Eigen::Vector3f& normal(std::size_t cube) const { return pieces_[cube].normal; }

  /** \brief Number of points on planes, and of those that are too few in their cube to tell. */
  struct Counts
  {
    std::size_t plane = 0;
    std::size_t narrow = 0;

    Counts& operator+=(const Counts& other)
    {
      plane += other.plane;
      narrow += other.narrow;
      return *this;
    }
  };
  [[nodiscard]] Counts count_points(const Parallel& parallel) const;

  /** \brief Marks by 1 the cubes whose points lie on one sheet that is nearly plane and goes on all around, as do those
   * of the cubes next to them: rims, bends, thin parts, noise and whatever is close to them are in others. */
  [[nodiscard]] PointArray<std::uint8_t> find_midst(const Parallel& parallel) const;

  /** \brief Calls body(point) for the points of a cube. */
  template <typename Body>
  void for_points(std::size_t cube, const Body& body) const
  {
    cubes_.for_points(cube, body);
  }

 private:
  enum class Shape : std::uint8_t
  {
    thick,   ///< bent, noisy, or more than one sheet
    narrow,  ///< too little to tell a plane from
    plane,
    inner  ///< plane, and its surface goes on all around
  };

  /** \brief The part of the surface in a cube. */
  struct Piece
  {
    std::uint64_t cube;
    Eigen::Vector3f middle;
    Eigen::Vector3f normal;
    Shape shape;
  };

  [[nodiscard]] Piece describe(const PointArray<Eigen::Vector3f>& position,
                               std::size_t cube,
                               double radius,
                               double thickest) const;
  [[nodiscard]] bool goes_on_all_around(const Piece& piece, const std::uint32_t* neighbors, std::size_t count) const;
  template <typename Body>
  void for_neighbors(std::size_t begin, std::size_t end, const Body& body) const;

  VoxelGrid grid_;
  VoxelRuns cubes_;
  PointArray<Piece> pieces_;
};

}  // namespace pds
