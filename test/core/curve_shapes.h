// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "shapes.h"

/** \brief Random points of curves whose shape is known. */
namespace pds_test
{

/** \brief A curve as a fine polyline. */
class ExactCurve
{
 public:
  /** \param at place at a parameter from 0 to 1 */
  ExactCurve(const std::function<Eigen::Vector3d(double)>& at, bool is_closed) : closed(is_closed)
  {
    constexpr std::size_t pieces = 20000;
    for (std::size_t i = 0; i <= pieces; ++i) {
      corner_.push_back(at(static_cast<double>(i) / pieces));
      reached_.push_back(i == 0 ? 0 : reached_.back() + (corner_[i] - corner_[i - 1]).norm());
    }
  }

  [[nodiscard]] double length() const { return reached_.back(); }
  [[nodiscard]] const Eigen::Vector3d& first() const { return corner_.front(); }
  [[nodiscard]] const Eigen::Vector3d& last() const { return corner_.back(); }

  /** \brief Points spread evenly by length, displaced in all directions. */
  [[nodiscard]] Points sample(std::size_t count, double deviation, std::uint64_t seed = 1) const
  {
    Random random(seed);
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
      const double place = random.uniform(0, length());
      const auto next = std::upper_bound(reached_.begin() + 1, reached_.end() - 1, place) - reached_.begin();
      const auto n = static_cast<std::size_t>(next);
      const double share = (place - reached_[n - 1]) / (reached_[n] - reached_[n - 1]);
      Eigen::Vector3d p = corner_[n - 1] + share * (corner_[n] - corner_[n - 1]);
      for (int axis = 0; axis < 3; ++axis) p[axis] += deviation * random.normal();
      points.push_back(p);
    }
    return points;
  }

  [[nodiscard]] double distance(const Eigen::Vector3d& p) const
  {
    std::size_t nearest = 0;
    for (std::size_t c = 1; c < corner_.size(); ++c)
      if ((corner_[c] - p).squaredNorm() < (corner_[nearest] - p).squaredNorm()) nearest = c;
    double least = (corner_[nearest] - p).norm();
    for (const std::size_t begin : {nearest, nearest + 1}) {
      if (begin == 0 || begin == corner_.size()) continue;
      const Eigen::Vector3d side = corner_[begin] - corner_[begin - 1];
      const double share = std::clamp((p - corner_[begin - 1]).dot(side) / side.squaredNorm(), 0.0, 1.0);
      least = std::min(least, (corner_[begin - 1] + share * side - p).norm());
    }
    return least;
  }

  bool closed;

 private:
  std::vector<Eigen::Vector3d> corner_;
  std::vector<double> reached_;  ///< by corner: length up to it
};

inline ExactCurve circle(const Eigen::Vector3d& center = {0, 0, 0},
                         const Eigen::Vector3d& u = {1, 0, 0},
                         const Eigen::Vector3d& v = {0, 1, 0})
{
  return {[=](double t) { return Eigen::Vector3d(center + std::cos(2 * pi * t) * u + std::sin(2 * pi * t) * v); },
          true};
}

inline ExactCurve trefoil_knot()
{
  return {[](double t) {
            const double a = 2 * pi * t;
            return Eigen::Vector3d(std::sin(a) + 2 * std::sin(2 * a), std::cos(a) - 2 * std::cos(2 * a),
                                   -std::sin(3 * a));
          },
          true};
}

/** \brief Three turns in a plane, half a unit apart. */
inline ExactCurve spiral()
{
  return {[](double t) {
            const double a = 6 * pi * t;
            return Eigen::Vector3d((0.5 + 1.5 * t) * std::cos(a), (0.5 + 1.5 * t) * std::sin(a), 0);
          },
          false};
}

}  // namespace pds_test
