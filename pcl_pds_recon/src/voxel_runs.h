// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <pcl_pds_recon/ordered_points.h>
#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/point_array.h>

namespace pds
{

/** \brief Numbers the voxels of a box, and one more on each side. What lies outside counts to the voxels at its sides.
 */
class VoxelGrid
{
 public:
  /** \param low corner of the box, where voxels begin \param side of a voxel \param voxels along each axis */
  VoxelGrid(const Eigen::Vector3d& low, double side, double voxels)
      : low_(low), voxels_per_unit_(1 / side), last_(voxels), axis_bits_(std::ilogb(voxels + 3) + 1)
  {
  }

  /** \brief False if there are too many voxels to number. */
  [[nodiscard]] bool usable() const { return axis_bits_ <= most_axis_bits; }
  [[nodiscard]] int key_bits() const { return 3 * axis_bits_; }

  [[nodiscard]] std::uint64_t voxel_of(const Eigen::Vector3f& p) const
  {
    std::uint64_t voxel = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double steps = (static_cast<double>(p[axis]) - low_[axis]) * voxels_per_unit_;
      // By way of a signed number: conversion to an unsigned one of 64 bits takes a branch.
      const auto number = static_cast<std::int64_t>(std::clamp(steps, 0.0, last_)) + 1;
      voxel = voxel << axis_bits_ | static_cast<std::uint64_t>(number);
    }
    return voxel;
  }

  /** \brief What is added to a voxel's number by steps along the axes; the last axis has numbers one after the other.
   */
  [[nodiscard]] std::int64_t step(std::int64_t x, std::int64_t y, std::int64_t z) const
  {
    const std::int64_t axis = std::int64_t{1} << axis_bits_;
    return (x * axis + y) * axis + z;
  }

 private:
  static constexpr int most_axis_bits = 21;  // of a voxel's number along an axis; three fit a 64-bit key

  Eigen::Vector3d low_;
  double voxels_per_unit_;
  double last_;
  int axis_bits_;
};

/** \brief Consecutive points in one voxel. */
struct VoxelRun
{
  std::uint64_t voxel;
  std::uint32_t begin, end;
};

/** \brief Runs of points by voxel, those of a voxel by rank. Points follow a Morton curve, so runs are few. */
class VoxelRuns
{
 public:
  VoxelRuns(const PointArray<Eigen::Vector3f>& position,
            std::size_t begin,
            std::size_t end,
            const VoxelGrid& grid,
            const Parallel& parallel);

  [[nodiscard]] std::size_t voxels() const { return voxel_begin_.size() - 1; }
  [[nodiscard]] std::uint64_t number(std::size_t voxel) const { return runs_[voxel_begin_[voxel]].voxel; }

  /** \brief Number of points in a voxel. */
  [[nodiscard]] std::size_t points(std::size_t voxel) const
  {
    std::size_t count = 0;
    for (std::size_t run = voxel_begin_[voxel]; run < voxel_begin_[voxel + 1]; ++run)
      count += runs_[run].end - runs_[run].begin;
    return count;
  }

  /** \brief Calls body(rank) for the points of a voxel. */
  template <typename Body>
  void for_points(std::size_t voxel, const Body& body) const
  {
    for (std::size_t run = voxel_begin_[voxel]; run < voxel_begin_[voxel + 1]; ++run)
      for (std::uint32_t i = runs_[run].begin; i < runs_[run].end; ++i) body(i);
  }

 private:
  PointArray<VoxelRun> runs_;
  PointArray<std::uint32_t> voxel_begin_;  ///< first run of every voxel; size voxels + 1
};

}  // namespace pds
