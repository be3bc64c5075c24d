// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/point_cloud_view.h>

#include <Eigen/Core>
#include <limits>

namespace pds
{

/** \brief Axis-aligned box. */
struct Bounds
{
  Eigen::Vector3d low = Eigen::Vector3d::Constant(std::numeric_limits<double>::infinity());
  Eigen::Vector3d high = Eigen::Vector3d::Constant(-std::numeric_limits<double>::infinity());

  void extend(const Eigen::Vector3d& p)
  {
    low = low.cwiseMin(p);
    high = high.cwiseMax(p);
  }
  Bounds& operator+=(const Bounds& other)
  {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
    return *this;
  }
  [[nodiscard]] double extent() const { return (high - low).maxCoeff(); }
};

/** \brief Where the finite points of a cloud are. */
struct CloudFrame
{
  std::size_t finite_points = 0;
  Bounds bounds;
  /** Component-wise: nearly all coordinates relative to it are small, whatever a few strays do. Of an even number of
   * values it is the upper one of the two in the middle. */
  Eigen::Vector3d median{0, 0, 0};
};

/** \brief Measures a cloud, exactly and whatever the order of its points. O(n). */
[[nodiscard]] CloudFrame measure_frame(const PointCloudView& cloud, const Parallel& parallel);

}  // namespace pds
