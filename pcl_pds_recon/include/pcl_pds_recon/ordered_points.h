// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/point_array.h>
#include <pcl_pds_recon/point_cloud_view.h>

namespace pds
{

/** \brief Marks an input point that has no place in the order: it is not finite, or an outlier. */
constexpr std::uint32_t no_rank = 0xffffffffU;

/** \brief The distinct finite points of a cloud in an order that depends on nothing but their coordinates.
 *
 * Positions are relative to the median of the points and scaled by a power of two into [-0.5, 0.5], so that single
 * precision loses nothing on coordinates far from the origin, a few stray points do not cost the others their
 * precision, and squares neither overflow nor vanish. Points that coincide at that precision are merged. The order
 * follows a Morton curve: neighbours in space are close in memory.
 */
struct OrderedPoints
{
  PointArray<Eigen::Vector3f> position;     ///< by rank
  PointArray<std::uint32_t> input_index;    ///< by rank: the input point that represents this place
  PointArray<std::uint32_t> rank_of_input;  ///< by input index: rank of its representative, or no_rank
  Eigen::Vector3d origin{0, 0, 0};          ///< input coordinates of position 0
  double unit = 1;                          ///< input units per unit of position
  std::size_t valid_points = 0;             ///< input points with finite coordinates
  std::size_t merged_points = 0;            ///< of these, represented by a coincident one
  std::size_t outliers = 0;                 ///< of the rest, left out (see outliers.h)
  std::size_t thinned_points = 0;           ///< of the rest, represented by one nearby (see thinning.h)
  bool smoothed = false;                    ///< positions are in the middle of the noise (see scan_noise.h)

  /** \brief Number of distinct points. */
  [[nodiscard]] std::size_t size() const { return position.size(); }
};

/** \brief Merges coincident points and puts the rest into Morton order. O(n log n).
 * \throws InvalidInput if there are 2^31 points or more, or the extent overflows
 */
[[nodiscard]] OrderedPoints order_points(const PointCloudView& cloud, const Parallel& parallel);

}  // namespace pds
