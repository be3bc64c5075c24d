// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pds
{

/** \brief Two parallel planes through points: as with k-means, sides and common normal are found in turn. Keeps its
 * working memory from fit to fit. */
class ParallelPlanes
{
 public:
  /** \param normal a first guess, unit \param middle and of the height that parts the points along it */
  void fit(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& normal, float middle);

  /** \brief Unit, from the lower plane to the upper one. */
  [[nodiscard]] const Eigen::Vector3f& normal() const { return normal_; }
  /** \brief Distance of the planes. */
  [[nodiscard]] float gap() const { return height_[1] - height_[0]; }
  /** \brief Height of the plane midway between them. */
  [[nodiscard]] float middle() const { return 0.5F * (height_[0] + height_[1]); }
  /** \brief Standard deviation of the points from their planes, over the gap. */
  [[nodiscard]] float blur() const;
  /** \brief How many points are nearer to the plane that has fewer. */
  [[nodiscard]] std::size_t fewer() const { return std::min(count_[0], count_[1]); }
  /** \brief True if points of both planes lie over the same place. */
  [[nodiscard]] bool overlap() const;
  /** \brief True if the points of both spread over their plane: those of a wall, seen along it, are on a line.
   * \param points those of the fit */
  [[nodiscard]] bool spread_both(const std::vector<Eigen::Vector3f>& points) const;

 private:
  bool split(const std::vector<Eigen::Vector3f>& points, float middle);
  void find_axes(const std::vector<Eigen::Vector3f>& points);

  Eigen::Vector3f normal_ = Eigen::Vector3f::Zero();
  Eigen::Vector3f variance_ = Eigen::Vector3f::Zero();  ///< about the means of the sides, ascending
  std::array<Eigen::Vector3f, 2> mean_;                 ///< of the sides
  std::array<float, 2> height_{};                       ///< of the means
  std::array<std::size_t, 2> count_{};
  std::vector<std::uint8_t> side_;  ///< by point: 0 lower, 1 upper
};

}  // namespace pds
