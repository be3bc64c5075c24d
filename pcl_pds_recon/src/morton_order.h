// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pcl_pds_recon/ordered_points.h>
#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/point_array.h>
#include "cloud_frame.h"

namespace pds
{

struct KeyedPoint
{
  std::uint64_t key;
  std::uint32_t index;
};

/** \brief Morton curve through the cube on the lower corner of a box. */
class MortonCurve
{
 public:
  static constexpr int axis_bits = 21;  ///< of a key; three axes fill 63 of its 64 bits

  explicit MortonCurve(const Bounds& bounds)
      : low_(bounds.low), cells_per_unit_(bounds.extent() > 0 ? cells / bounds.extent() : 0.0)
  {
  }
  /** \brief Through at least that cube, so that \a cells_per_voxel of its cells are as long as a voxel. */
  MortonCurve(const Bounds& bounds, double voxel_side, double cells_per_voxel)
      : low_(bounds.low), cells_per_unit_(cells_per_voxel / voxel_side)
  {
  }

  /** \brief Place of \a p on the curve. */
  [[nodiscard]] std::uint64_t key(const Eigen::Vector3d& p) const
  {
    std::uint64_t key = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double cell = std::min((p[axis] - low_[axis]) * cells_per_unit_, cells - 1);
      // By way of a signed number: conversion to an unsigned one of 64 bits takes a branch.
      key |= spread_bits(static_cast<std::uint64_t>(static_cast<std::int64_t>(cell))) << axis;
    }
    return key;
  }

 private:
  /** \brief Spreads the low 21 bits so that two zero bits follow each. */
  static std::uint64_t spread_bits(std::uint64_t v)
  {
    v &= 0x1fffff;
    v = (v | v << 32) & 0x1f00000000ffffULL;
    v = (v | v << 16) & 0x1f0000ff0000ffULL;
    v = (v | v << 8) & 0x100f00f00f00f00fULL;
    v = (v | v << 4) & 0x10c30c30c30c30c3ULL;
    v = (v | v << 2) & 0x1249249249249249ULL;
    return v;
  }

  static constexpr auto cells = static_cast<double>(1 << axis_bits);
  Eigen::Vector3d low_;
  double cells_per_unit_;
};

/** \brief The points in their own frame, and the order of those that the curve does not tell apart. */
class FramedCloud
{
 public:
  FramedCloud(const PointCloudView& cloud, const OrderedPoints& points)
      : cloud_(cloud),
        origin_(points.origin),
        half_per_unit_(std::ldexp(1.0, -(std::ilogb(points.unit) / 2))),
        rest_per_unit_(std::ldexp(1.0, std::ilogb(points.unit) / 2 - std::ilogb(points.unit)))
  {
  }

  void prefetch(std::uint32_t index) const { cloud_.positions.prefetch(index); }

  /** \brief A point of the cloud in the frame, at the precision it is kept with.
   *
   * Not inlined: GCC 12 leaves out the rounding where it vectorises a conversion to float and back to double. */
  [[nodiscard, gnu::noinline]] Eigen::Vector3f position(const Eigen::Vector3d& p) const
  {
    return ((p - origin_) * half_per_unit_ * rest_per_unit_).cast<float>();
  }
  [[nodiscard]] Eigen::Vector3f position(std::uint32_t index) const { return position(cloud_.positions[index]); }

  /** \brief Lexicographic by position, input coordinates, the caller's record order, index. */
  [[nodiscard]] bool before(std::uint32_t a, std::uint32_t b) const
  {
    if (const int c = compare(position(a), position(b)); c != 0) return c < 0;
    if (const int c = compare(cloud_.positions[a], cloud_.positions[b]); c != 0) return c < 0;
    if (cloud_.record_less) {
      if (cloud_.record_less(a, b)) return true;
      if (cloud_.record_less(b, a)) return false;
    }
    return a < b;
  }

 private:
  template <typename Vector>
  static int compare(const Vector& a, const Vector& b)
  {
    for (int axis = 0; axis < 3; ++axis)
      if (a[axis] != b[axis]) return a[axis] < b[axis] ? -1 : 1;
    return 0;
  }

  const PointCloudView& cloud_;
  Eigen::Vector3d origin_;
  // Factors of the unit's inverse, which would overflow for the least of units. Exact, for it is a power of two.
  double half_per_unit_, rest_per_unit_;
};

/** \brief Sorts points along the curve; those that share a cell of it by FramedCloud::before or, if they are many,
 * along a finer curve through their own box. The latter happens where a stray point far away makes cells huge. */
class CurveSort
{
 public:
  explicit CurveSort(const FramedCloud& cloud) : cloud_(cloud) {}

  /** \brief Sorts points that agree in all bits of their keys but the lowest \a open_bits.
   * \param other an array as large
   * \return which of the two arrays holds the sorted points
   */
  KeyedPoint* sort(
      KeyedPoint* points, KeyedPoint* other, std::size_t count, int open_bits, const Parallel& parallel) const;

  /** \brief Sorts each run of points that agree in all but \a open_bits bits, in place. */
  void sort_runs(
      KeyedPoint* points, KeyedPoint* other, std::size_t count, int open_bits, const Parallel& parallel) const;

 private:
  bool enter_cell(KeyedPoint* points, std::size_t count, const Parallel& parallel) const;

  const FramedCloud& cloud_;
  Parallel alone_{1};
};

/** \brief Points that get their place while one comes from memory. */
constexpr std::size_t places_ahead = 32;

/** \brief Has a point near when its turn comes. */
inline void fetch(const FramedCloud& cloud, std::uint32_t index, const OrderedPoints& points)
{
  cloud.prefetch(index);
  __builtin_prefetch(&points.rank_of_input[index], 1);
}

/** \brief Gives \a points a frame, but no points yet, and counts the finite ones.
 * \return box of these in the frame
 */
[[nodiscard]] Bounds set_frame(const PointCloudView& cloud, OrderedPoints& points, const Parallel& parallel);

/** \brief The finite points with their keys, in the order of the input. */
[[nodiscard]] PointArray<KeyedPoint> keyed_points(const PointCloudView& cloud,
                                                  const FramedCloud& framed,
                                                  std::size_t finite_points,
                                                  const MortonCurve& curve,
                                                  const Parallel& parallel);

/** \brief Gives places to sorted points, coincident ones the same. */
void assign_ranks(const FramedCloud& cloud, const KeyedPoint* sorted, OrderedPoints& points, const Parallel& parallel);

}  // namespace pds
