// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

#include <pcl_pds_recon/neighbor_graph.h>

namespace pds
{

/** \brief Plane fitted to the neighbourhood of each point. */
struct SurfaceEstimate
{
  PointArray<Eigen::Vector3f> normal;  ///< unit, of arbitrary sign; zero where the neighbourhood is no surface
  PointArray<float> curvature;         ///< square root of the surface variation (smallest eigenvalue over their sum)
  PointArray<std::uint8_t> inside;     ///< 1 where the neighbours lie all around, so hardly ever at a rim; else 0
};

/** \brief The metric in which disks are grown: an edge is its length times the mean weight of its two ends.
 *
 * Weights are at least 1, so that no distance falls below the Euclidean one.
 */
class EdgeWeights
{
 public:
  /** \brief The uniform metric: weight 1 everywhere. */
  EdgeWeights() = default;
  /** \param weight per point, at least 1; empty = uniform */
  explicit EdgeWeights(std::vector<float> weight)
      : weight_(std::move(weight)), least_(weight_.empty() ? 1.0F : *std::min_element(weight_.begin(), weight_.end()))
  {
  }

  /** \brief True if all weights are 1. */
  [[nodiscard]] bool uniform() const { return weight_.empty(); }
  /** \brief Weight of point \a i. */
  [[nodiscard]] float at(std::size_t i) const { return weight_.empty() ? 1.0F : weight_[i]; }
  /** \brief The least weight of all: times the Euclidean distance, a lower bound of every distance. */
  [[nodiscard]] float least() const { return least_; }

 private:
  std::vector<float> weight_;
  float least_ = 1.0F;
};

/** \brief Fits a plane to every point and its own nearest neighbours. O(n k). */
[[nodiscard]] SurfaceEstimate estimate_surface(const OrderedPoints& points,
                                               const NeighborGraph& graph,
                                               const Parallel& parallel);

/** \brief Points of this feature rank or a higher one are on rims, or on creases that bend by 30 degrees or more. */
constexpr std::uint8_t crease_rank = 40;

/** \brief How much each point deserves to be a seed, 0 ... 255. Vertices on ridges, creases, corners and rims carry
 * a mesh; points between them are interpolated.
 *
 * Flat points have a rank of 0 ... 15, in half means of the smoothed curvature. Where the surface bends within a
 * neighbourhood, the rank is higher by how far the point is above the mean of its neighbours: on a crease that is more
 * than beside it, and at a corner more than on a crease; on a rim, by how far that mean is inwards. O(n k). */
[[nodiscard]] std::vector<std::uint8_t> feature_ranks(const OrderedPoints& points,
                                                      const SurfaceEstimate& surface,
                                                      const NeighborGraph& graph,
                                                      const Parallel& parallel);

/** \brief What bounds the adaptive weights. */
struct WeightLimits
{
  double disk_intervals = 3.0;  ///< radius of a disk in (unweighted) sampling intervals ...
  bool at_mean_weight = true;   ///< ... where the weight is its mean; false: where it is 1
};

/** \brief Adaptive weights exp(c x) of the paper's section "Uniform and adaptive reconstruction".
 *
 * x is the smoothed curvature over its mean. Weights are bounded so that the smallest disks still hold enough points
 * for a Voronoi cell: without that, meshes tear where they should be finest.
 * \param coefficient c (0 gives the uniform metric)
 */
[[nodiscard]] EdgeWeights curvature_weights(const SurfaceEstimate& surface,
                                            const NeighborGraph& graph,
                                            double coefficient,
                                            const WeightLimits& limits,
                                            const Parallel& parallel);

/** \brief Mean over all points of the weighted distances to their own neighbours, in units of position. O(n k); of the
 * uniform metric the graph knows it. */
[[nodiscard]] double mean_weighted_interval(const OrderedPoints& points,
                                            const NeighborGraph& graph,
                                            const EdgeWeights& weights,
                                            const Parallel& parallel);

}  // namespace pds
