// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/edge_weights.h>

#include <algorithm>
#include <cmath>

#include "plane_kernel.h"

namespace pds
{
namespace
{

constexpr std::size_t block = 4096;       // points per block
constexpr double smallest_disk = 1.6;     // intervals: about 16 points at k = 15; below it cells fall apart
constexpr double largest_exponent = 5.0;  // c x; beyond it exp() only names outliers
constexpr int fixed_point_steps = 20;
constexpr int weight_smoothing = 3;        // rounds of averaging: a metric that jumps within a disk tears the mesh
constexpr int feature_smoothing = 1;       // wider than noise, narrow enough to tell a crease from its flanks
constexpr float least_rim_offset = 0.65F;  // intervals; the mean of neighbours is 0.9 from a straight rim, 0.25 inside

/** \brief A field of the points with its mean. */
struct Field
{
  PointArray<float> value;
  double mean = 0;
};

/** \brief The field, averaged over each point and its own neighbours so many times. */
Field smoothed(const PointArray<float>& field, int rounds, const NeighborGraph& graph, const Parallel& parallel)
{
  Field smooth{field, 0.0};
  PointArray<float> next(field.size());
  for (int round = 0; round < rounds; ++round) {
    const double sum = parallel.sum(field.size(), block, [&](std::size_t begin, std::size_t end) {
      double part = 0;
      for (std::size_t i = begin; i < end; ++i) {
        const NeighborSpan nearest = graph.nearest(i);
        float around = smooth.value[i];
        for (const std::uint32_t j : nearest) around += smooth.value[j];
        next[i] = around / static_cast<float>(nearest.size() + 1);
        part += static_cast<double>(next[i]);
      }
      return part;
    });
    smooth.value.swap(next);
    if (!field.empty()) smooth.mean = sum / static_cast<double>(field.size());
  }
  return smooth;
}

/** \brief The way from a point to the mean of its own neighbours. */
Eigen::Vector3f way_to_neighbors(std::size_t point, const OrderedPoints& points, const NeighborGraph& graph)
{
  const NeighborSpan nearest = graph.nearest(point);
  Eigen::Vector3f sum = Eigen::Vector3f::Zero();
  for (const std::uint32_t j : nearest) sum += points.position[j] - points.position[point];
  return sum / static_cast<float>(std::max<std::size_t>(nearest.size(), 1));
}

/** \brief True if a point is on the rim: its neighbours are off to one side, and on the other there is a wedge of 120
 * degrees without any. Of random points that is one in a thousand inside, and most within R / 10 of the rim.
 * \param inwards the way to the mean of the neighbours */
bool is_on_rim(std::size_t point,
               const Eigen::Vector3f& inwards,
               const OrderedPoints& points,
               const NeighborGraph& graph)
{
  constexpr float wedge = 0.5F;  // cosine of half of its angle
  const float offset = inwards.norm();
  if (offset < least_rim_offset * static_cast<float>(graph.sampling_interval)) return false;
  const NeighborSpan nearest = graph.nearest(point);
  return std::all_of(nearest.begin(), nearest.end(), [&](std::uint32_t j) {
    const Eigen::Vector3f way = points.position[j] - points.position[point];
    return way.dot(inwards) >= -wedge * offset * way.norm();
  });
}

/** \brief The greatest weight that leaves disks of smallest_disk intervals, at least 1.
 *
 * If the radius goes with the mean weight, lowering the bound lowers that mean; the fixed point is found by iteration,
 * which converges because each step moves the mean less than the bound.
 */
double largest_weight(const std::vector<float>& weights, const WeightLimits& limits, const Parallel& parallel)
{
  const double room = limits.disk_intervals / smallest_disk;
  if (!limits.at_mean_weight) return std::max(1.0, room);
  double bound = std::exp(largest_exponent);
  for (int step = 0; step < fixed_point_steps; ++step) {
    const double sum = parallel.sum(weights.size(), block, [&](std::size_t begin, std::size_t end) {
      double part = 0;
      for (std::size_t i = begin; i < end; ++i) part += std::min(static_cast<double>(weights[i]), bound);
      return part;
    });
    bound = std::max(1.0, room * sum / static_cast<double>(weights.size()));
  }
  return bound;
}

}  // namespace

SurfaceEstimate estimate_surface(const OrderedPoints& points, const NeighborGraph& graph, const Parallel& parallel)
{
  SurfaceEstimate surface;
  surface.normal.resize(points.size());
  surface.curvature.resize(points.size());
  surface.inside.resize(points.size());
  const InstructionSet set = best_instruction_set();
  parallel.blocks(points.size(), block, [&](std::size_t begin, std::size_t end, unsigned) {
    fit_planes(set, points, graph, begin, end, surface);
  });
  return surface;
}

std::vector<std::uint8_t> feature_ranks(const OrderedPoints& points,
                                        const SurfaceEstimate& surface,
                                        const NeighborGraph& graph,
                                        const Parallel& parallel)
{
  constexpr float bent = 0.04F;  // curvature: 12 degrees within the neighbourhood
  constexpr float highest_flat = 15.0F;
  constexpr float lowest_bent = 16.0F;
  constexpr float highest = 255.0F;
  constexpr float ranks_per_interval = 240.0F;  // a right angle's edge is 0.45 intervals above the mean, its corner 0.7
  // At a rim the mean is 0.9 intervals away, at its corners 1.3. That is less than most creases have: where chance
  // leaves a gap beside a crease, it takes no seed from it.
  constexpr float rim_ranks_per_interval = 40.0F;
  const Field curvature = smoothed(surface.curvature, feature_smoothing, graph, parallel);
  const auto step = static_cast<float>(0.5 * curvature.mean);
  std::vector<std::uint8_t> ranks(curvature.value.size());
  if (!(graph.sampling_interval > 0)) return ranks;  // a point alone
  const auto intervals = static_cast<float>(1 / graph.sampling_interval);
  parallel.each(ranks.size(), block, [&](std::size_t i) {
    float rank = step > 0 ? std::min(curvature.value[i] / step, highest_flat) : 0.0F;
    if (surface.curvature[i] >= bent) {
      rank = lowest_bent +
             ranks_per_interval * intervals * std::abs(way_to_neighbors(i, points, graph).dot(surface.normal[i]));
    } else if (surface.inside[i] == 0) {
      const Eigen::Vector3f inwards = way_to_neighbors(i, points, graph);
      if (is_on_rim(i, inwards, points, graph))
        rank = crease_rank + rim_ranks_per_interval * (intervals * inwards.norm() - least_rim_offset);
    }
    ranks[i] = static_cast<std::uint8_t>(std::min(rank, highest));
  });
  return ranks;
}

EdgeWeights curvature_weights(const SurfaceEstimate& surface,
                              const NeighborGraph& graph,
                              double coefficient,
                              const WeightLimits& limits,
                              const Parallel& parallel)
{
  if (coefficient == 0) return {};
  Field curvature = smoothed(surface.curvature, weight_smoothing, graph, parallel);
  if (curvature.mean <= 0) return {};
  std::vector<float> weight(curvature.value.size());
  parallel.each(weight.size(), block, [&](std::size_t i) {
    const double x = static_cast<double>(curvature.value[i]) / curvature.mean;
    weight[i] = static_cast<float>(std::exp(std::min(coefficient * x, largest_exponent)));
  });
  const auto largest = static_cast<float>(largest_weight(weight, limits, parallel));
  parallel.each(weight.size(), block, [&](std::size_t i) { weight[i] = std::min(weight[i], largest); });
  return EdgeWeights(std::move(weight));
}

double mean_weighted_interval(const OrderedPoints& points,
                              const NeighborGraph& graph,
                              const EdgeWeights& weights,
                              const Parallel& parallel)
{
  if (weights.uniform()) return graph.sampling_interval;
  const auto count = static_cast<double>(parallel.sum(graph.size(), block, [&](std::size_t begin, std::size_t end) {
    std::size_t part = 0;
    for (std::size_t i = begin; i < end; ++i) part += graph.nearest(i).size();
    return part;
  }));
  const double sum = parallel.sum(graph.size(), block, [&](std::size_t begin, std::size_t end) {
    double part = 0;
    for (std::size_t i = begin; i < end; ++i)
      for (const std::uint32_t j : graph.nearest(i)) {
        const float length = (points.position[i] - points.position[j]).norm();
        part += static_cast<double>(length * 0.5F * (weights.at(i) + weights.at(j)));
      }
    return part;
  });
  return count > 0 ? sum / count : 0.0;
}

}  // namespace pds
