// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <algorithm>

namespace pds
{

/** \brief A face, for measuring where points are above it. */
class FacePlane
{
 public:
  /** \brief A point as the face sees it: barycentric coordinates of its foot on the plane, and its height above it. */
  struct View
  {
    double first, second, third, height;
  };

  /** \brief The plane of no face. */
  FacePlane() = default;
  /** \brief Of three corners, in radii. */
  FacePlane(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) : origin_(a)
  {
    const Eigen::Vector3d to_second = b - a;
    const Eigen::Vector3d to_third = c - a;
    const Eigen::Vector3d area = to_second.cross(to_third);
    const double doubled = area.norm();
    if (doubled < flat) return;
    normal_ = area / doubled;
    second_ = to_third.cross(normal_) / doubled;
    third_ = normal_.cross(to_second) / doubled;
  }

  /** \brief False if the corners are on a line, or nearly so. */
  [[nodiscard]] bool valid() const { return normal_ != Eigen::Vector3d::Zero(); }
  /** \brief Unit; zero if the plane is not valid. */
  [[nodiscard]] const Eigen::Vector3d& normal() const { return normal_; }
  [[nodiscard]] View view(const Eigen::Vector3d& point) const
  {
    const Eigen::Vector3d way = point - origin_;
    const double second = way.dot(second_);
    const double third = way.dot(third_);
    return {1 - second - third, second, third, way.dot(normal_)};
  }

  /** \brief Squared distance of a point from the face, in squared radii. Beyond a side it is only guessed: heights of
   * faces are about a radius. In plain arithmetic, of which loops over points become vector code. */
  [[nodiscard]] double distance2(double x, double y, double z) const
  {
    const double dx = x - origin_.data()[0], dy = y - origin_.data()[1], dz = z - origin_.data()[2];
    const auto along = [&](const Eigen::Vector3d& v) { return dx * v.data()[0] + dy * v.data()[1] + dz * v.data()[2]; };
    const double height = along(normal_);
    const double second = along(second_);
    const double third = along(third_);
    const double first = 1 - second - third;
    const double lower = second < third ? second : third;
    const double least = first < lower ? first : lower;
    const double beyond = least < 0 ? least : 0;
    return height * height + beyond * beyond;
  }
  [[nodiscard]] double distance2(const Eigen::Vector3d& point) const
  {
    return distance2(point.x(), point.y(), point.z());
  }

 private:
  static constexpr double flat = 1e-12;  // twice the area, in squared radii, of a face without a normal

  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
  // Product with the way from the first corner: barycentric coordinates.
  Eigen::Vector3d second_ = Eigen::Vector3d::Zero();
  Eigen::Vector3d third_ = Eigen::Vector3d::Zero();
};

}  // namespace pds
