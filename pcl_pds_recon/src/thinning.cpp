// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/thinning.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <utility>
#include "representatives.h"
#include "voxel_runs.h"

namespace pds
{
namespace
{

// Before all points of a large cloud are grouped, some stretches of it tell what that would gain: somewhat too little,
// for they have but a part of the points of the voxels at their ends.
constexpr std::size_t stretches = 16;
constexpr std::size_t stretch = 2048;        // points
constexpr double least_expected_gain = 1.9;  // points per voxel

/** \brief False if so many points share a voxel in no part of a large cloud that grouping them could pay. Points follow
 * a Morton curve, so a stretch of them is a compact piece. */
bool may_pay(const OrderedPoints& points, const VoxelGrid& grid, const Parallel& parallel)
{
  if (points.size() < 4 * stretches * stretch) return true;
  const auto voxels = parallel.sum(stretches, 1, [&](std::size_t number, std::size_t) {
    const std::size_t first = number * (points.size() / stretches);
    std::array<std::uint64_t, stretch> voxel;
    for (std::size_t i = 0; i < stretch; ++i) voxel[i] = grid.voxel_of(points.position[first + i]);
    std::sort(voxel.begin(), voxel.end());
    return static_cast<std::size_t>(std::unique(voxel.begin(), voxel.end()) - voxel.begin());
  });
  return static_cast<double>(stretches * stretch) >= least_expected_gain * static_cast<double>(voxels);
}

/** \brief The point nearest to the mean of a voxel's. */
std::uint32_t middle_point(const OrderedPoints& points, const VoxelRuns& voxels, std::size_t voxel)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  voxels.for_points(voxel, [&](std::uint32_t i) {
    sum += points.position[i].cast<double>();
    ++count;
  });
  const Eigen::Vector3f mean = (sum / static_cast<double>(count)).cast<float>();
  std::uint32_t middle = 0;
  float least = std::numeric_limits<float>::infinity();
  voxels.for_points(voxel, [&](std::uint32_t i) {
    const float distance = (points.position[i] - mean).squaredNorm();
    if (distance >= least) return;
    least = distance;
    middle = i;
  });
  return middle;
}

Representatives choose_representatives(const OrderedPoints& points, const VoxelRuns& voxels, const Parallel& parallel)
{
  constexpr std::size_t voxels_per_block = 1024;
  Representatives representative(points.size());
  parallel.each(voxels.voxels(), voxels_per_block, [&](std::size_t voxel) {
    const std::uint32_t middle = middle_point(points, voxels, voxel);
    voxels.for_points(voxel, [&](std::uint32_t i) { representative[i] = middle; });
  });
  return representative;
}

}  // namespace

OrderedPoints thin_points(OrderedPoints points, double voxel_side, const Parallel& parallel)
{
  for (double side = std::min(voxel_side, 1.0); points.size() >= fewest_points_to_thin; side /= 2) {
    const VoxelGrid grid(Eigen::Vector3d::Constant(-0.5), side, 1 / side);
    if (!grid.usable() || !may_pay(points, grid, parallel)) break;
    const VoxelRuns voxels(points.position, 0, points.size(), grid, parallel);
    if (!thinning_pays(points.size(), voxels.voxels())) break;
    if (voxels.voxels() < fewest_points_left) continue;
    const Representatives representative = choose_representatives(points, voxels, parallel);
    return keep_representatives(std::move(points), representative, parallel);
  }
  return points;
}

}  // namespace pds
