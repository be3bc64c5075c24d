// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/scan_noise.h>

#include <algorithm>
#include "spread.h"

namespace pds
{
namespace
{

using Vectors = PointArray<Eigen::Vector3f>;  ///< by point

constexpr std::size_t block = 4096;  // points per block

// Thickness of a neighbourhood of 15 points on noise of a tenth of the sampling interval. Nine in ten points of a clean
// scan have less, median 0.04; raw scans have a median of 0.15 to 0.4, an isotropic cloud 0.58.
constexpr double visible = 0.1;
constexpr double filled = 0.3;        // a neighbourhood this thick may lie wholly within the noise
constexpr double thin = 0.2;          // a plane this thin needs no wider one
constexpr double fading = 0.9;        // noise falls by more when one looks wider; creases stay what they are
constexpr int common_rounds = 3;      // of averaging: what noise has in common with 50 points around is little
constexpr double noisy_share = 0.25;  // of the points, from which on a cloud counts as noisy; clean scans have 0.01

/** \brief A point's neighbours and theirs, those weighing most that are most often neighbours. */
Spread spread_of_two_rings(const OrderedPoints& points, const NeighborGraph& graph, std::size_t i)
{
  SpreadSum sum(spread_around(points, graph, i));
  for (const std::uint32_t j : graph.nearest(i)) sum.add(spread_around(points, graph, j));
  return sum.mean();
}

Spread spread_of_three_rings(const OrderedPoints& points, const NeighborGraph& graph, std::size_t i)
{
  SpreadSum sum(spread_of_two_rings(points, graph, i));
  for (const std::uint32_t j : graph.nearest(i)) sum.add(spread_of_two_rings(points, graph, j));
  return sum.mean();
}

bool has_noise(const OrderedPoints& points, const NeighborGraph& graph, std::size_t i)
{
  const double near = spread_around(points, graph, i).plane().thickness;
  if (near < visible) return false;
  const Spread wide = near < filled ? spread_of_two_rings(points, graph, i) : spread_of_three_rings(points, graph, i);
  return wide.plane().thickness < fading * near;
}

/** \brief How each point gets to the plane of its neighbours or, where noise fills these, of their neighbours. */
Vectors moves_to_planes(const OrderedPoints& points, const NeighborGraph& graph, const Parallel& parallel)
{
  PointArray<Spread> around(points.size());
  parallel.each(points.size(), block, [&](std::size_t i) { around[i] = spread_around(points, graph, i); });
  Vectors move(points.size());
  parallel.each(points.size(), block, [&](std::size_t i) {
    FittedPlane plane = around[i].plane();
    if (plane.thickness > thin) {
      SpreadSum sum(around[i]);
      for (const std::uint32_t j : graph.nearest(i)) sum.add(around[j]);
      const FittedPlane wider = sum.mean().plane();
      if (wider.thickness < fading * plane.thickness) plane = wider;
    }
    move[i] = plane.project(points.position[i]) - points.position[i];
  });
  return move;
}

/** \brief Each point's mean with its own neighbours. */
Vectors averaged(const Vectors& of_points, const NeighborGraph& graph, const Parallel& parallel)
{
  Vectors mean(of_points.size());
  parallel.each(mean.size(), block, [&](std::size_t i) {
    Eigen::Vector3f sum = of_points[i];
    for (const std::uint32_t j : graph.nearest(i)) sum += of_points[j];
    mean[i] = sum / static_cast<float>(graph.nearest(i).size() + 1);
  });
  return mean;
}

}  // namespace

bool is_noisy(const OrderedPoints& points,
              const NeighborGraph& graph,
              const Parallel& parallel,
              std::size_t clean_points)
{
  constexpr std::size_t least_samples = 1024;
  constexpr std::size_t largest_stride = 256;
  const std::size_t stride = std::clamp<std::size_t>(graph.size() / least_samples, 1, largest_stride);
  constexpr std::size_t samples_per_block = 16;
  const std::size_t samples = (graph.size() + stride - 1) / stride;
  const std::size_t noisy = parallel.sum(samples, samples_per_block, [&](std::size_t begin, std::size_t end) {
    std::size_t part = 0;
    for (std::size_t s = begin; s < end; ++s) part += has_noise(points, graph, s * stride) ? 1 : 0;
    return part;
  });
  const auto left = static_cast<double>(graph.size());
  const double share_left = left / (left + static_cast<double>(clean_points));
  return static_cast<double>(noisy) * share_left > noisy_share * static_cast<double>(samples);
}

PointArray<Eigen::Vector3f> smooth_positions(const OrderedPoints& points,
                                             const NeighborGraph& graph,
                                             const Parallel& parallel)
{
  Vectors smooth = moves_to_planes(points, graph, parallel);
  // Noise has no preference for either side, so what neighbours have in common is the bend of the surface.
  Vectors common = smooth;
  for (int round = 0; round < common_rounds; ++round) common = averaged(common, graph, parallel);
  parallel.each(smooth.size(), block, [&](std::size_t i) {
    // Within the box, which is what later stages count on.
    smooth[i] = (points.position[i] + smooth[i] - common[i]).cwiseMax(-0.5F).cwiseMin(0.5F);
  });
  return smooth;
}

std::vector<std::uint8_t> middle_ranks(const PointCloudView& cloud,
                                       const OrderedPoints& points,
                                       const Parallel& parallel)
{
  constexpr double highest = 15.0;
  constexpr double steps_per_mean = 4.0;
  PointArray<float> offset(points.size());
  const double sum = parallel.sum(points.size(), block, [&](std::size_t begin, std::size_t end) {
    double part = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3d scanned = (cloud.positions[points.input_index[i]] - points.origin) / points.unit;
      const double moved = (scanned - points.position[i].cast<double>()).norm();
      offset[i] = static_cast<float>(moved);
      part += moved;
    }
    return part;
  });
  const double step = sum / static_cast<double>(points.size()) / steps_per_mean;
  std::vector<std::uint8_t> ranks(points.size());
  if (step > 0)
    parallel.each(points.size(), block, [&](std::size_t i) {
      ranks[i] = static_cast<std::uint8_t>(highest - std::min(static_cast<double>(offset[i]) / step, highest));
    });
  return ranks;
}

}  // namespace pds
