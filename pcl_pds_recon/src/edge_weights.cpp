// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/edge_weights.h>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace pds
{
namespace
{

constexpr std::size_t block = 4096;       // points per block
constexpr double smallest_disk = 1.6;     // intervals: about 16 points at k = 15; below it cells fall apart
constexpr double largest_exponent = 5.0;  // c x; beyond it exp() only names outliers
constexpr int fixed_point_steps = 20;
constexpr int weight_smoothing = 3;   // rounds of averaging: a metric that jumps within a disk tears the mesh
constexpr int feature_smoothing = 1;  // wider than noise, narrow enough to tell a crease from its flanks

Eigen::Matrix3d neighborhood_covariance(const OrderedPoints& points, const NeighborGraph& graph, std::size_t i)
{
  // Relative to the point itself: what is left has no cancellation.
  const NeighborSpan nearest = graph.nearest(i);
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (const std::uint32_t j : nearest) {
    const Eigen::Vector3d d = (points.position[j] - points.position[i]).cast<double>();
    mean += d;
    moment += d * d.transpose();
  }
  const auto count = static_cast<double>(nearest.size() + 1);
  mean /= count;
  return moment / count - mean * mean.transpose();
}

std::vector<float> smoothed(std::vector<float> field, int rounds, const NeighborGraph& graph, const Parallel& parallel)
{
  std::vector<float> next(field.size());
  for (int round = 0; round < rounds; ++round) {
    parallel.each(field.size(), block, [&](std::size_t i) {
      float sum = field[i];
      for (const std::uint32_t j : graph.nearest(i)) sum += field[j];
      next[i] = sum / static_cast<float>(graph.nearest(i).size() + 1);
    });
    field.swap(next);
  }
  return field;
}

double mean(const std::vector<float>& values)
{
  double sum = 0;
  for (const float v : values) sum += static_cast<double>(v);
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

/** \brief The greatest weight that leaves disks of smallest_disk intervals, at least 1.
 *
 * If the radius goes with the mean weight, lowering the bound lowers that mean; the fixed point is found by iteration,
 * which converges because each step moves the mean less than the bound.
 */
double largest_weight(const std::vector<float>& weights, const WeightLimits& limits)
{
  const double room = limits.disk_intervals / smallest_disk;
  if (!limits.at_mean_weight) return std::max(1.0, room);
  double bound = std::exp(largest_exponent);
  for (int step = 0; step < fixed_point_steps; ++step) {
    double sum = 0;
    for (const float w : weights) sum += std::min(static_cast<double>(w), bound);
    bound = std::max(1.0, room * sum / static_cast<double>(weights.size()));
  }
  return bound;
}

}  // namespace

SurfaceEstimate estimate_surface(const OrderedPoints& points, const NeighborGraph& graph, const Parallel& parallel)
{
  SurfaceEstimate surface;
  surface.normal.assign(graph.size(), Eigen::Vector3f::Zero());
  surface.curvature.assign(graph.size(), 0.0F);
  parallel.each(graph.size(), block, [&](std::size_t i) {
    if (graph.nearest(i).size() < 2) return;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(neighborhood_covariance(points, graph, i));
    const Eigen::Vector3d eigenvalues = solver.eigenvalues().cwiseMax(0.0);
    surface.normal[i] = solver.eigenvectors().col(0).cast<float>();
    if (eigenvalues.sum() > 0) surface.curvature[i] = static_cast<float>(std::sqrt(eigenvalues[0] / eigenvalues.sum()));
  });
  return surface;
}

std::vector<std::uint8_t> feature_ranks(const SurfaceEstimate& surface,
                                        const NeighborGraph& graph,
                                        const Parallel& parallel)
{
  constexpr float highest = 15.0F;
  const std::vector<float> curvature = smoothed(surface.curvature, feature_smoothing, graph, parallel);
  const auto step = static_cast<float>(0.5 * mean(curvature));
  std::vector<std::uint8_t> ranks(curvature.size());
  if (step > 0)
    parallel.each(ranks.size(), block,
                  [&](std::size_t i) { ranks[i] = static_cast<std::uint8_t>(std::min(curvature[i] / step, highest)); });
  return ranks;
}

EdgeWeights curvature_weights(const SurfaceEstimate& surface,
                              const NeighborGraph& graph,
                              double coefficient,
                              const WeightLimits& limits,
                              const Parallel& parallel)
{
  if (coefficient == 0) return {};
  std::vector<float> weight = smoothed(surface.curvature, weight_smoothing, graph, parallel);
  const double mean_curvature = mean(weight);
  if (mean_curvature <= 0) return {};
  for (float& w : weight)
    w = static_cast<float>(std::exp(std::min(coefficient * static_cast<double>(w) / mean_curvature, largest_exponent)));
  const auto largest = static_cast<float>(largest_weight(weight, limits));
  for (float& w : weight) w = std::min(w, largest);
  return EdgeWeights(std::move(weight));
}

double mean_weighted_interval(const OrderedPoints& points, const NeighborGraph& graph, const EdgeWeights& weights)
{
  double sum = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < graph.size(); ++i)
    for (const std::uint32_t j : graph.nearest(i)) {
      const float length = (points.position[i] - points.position[j]).norm();
      sum += static_cast<double>(length * 0.5F * (weights.at(i) + weights.at(j)));
      ++count;
    }
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

}  // namespace pds
