// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/thinning.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include "parallel_parts.h"
#include "radix_sort.h"

namespace pds
{
namespace
{

constexpr std::size_t block = 16384;  // points per block
constexpr int most_axis_bits = 21;    // of a voxel's number along an axis; three fit a 64-bit key

// Before all points of a large cloud are grouped, some stretches of it tell what that would gain: somewhat too little,
// for they have but a part of the points of the voxels at their ends.
constexpr std::size_t stretches = 16;
constexpr std::size_t stretch = 2048;        // points
constexpr double least_expected_gain = 1.9;  // points per voxel

/** \brief Consecutive points in one voxel. */
struct VoxelRun
{
  std::uint64_t voxel;
  std::uint32_t begin, end;
};

/** \brief Numbers the voxels of the cube [-0.5, 0.5], in which all positions are. */
class VoxelGrid
{
 public:
  explicit VoxelGrid(double side)
      : voxels_per_unit_(1 / std::min(side, 1.0)), axis_bits_(std::ilogb(voxels_per_unit_ + 2) + 1)
  {
  }

  /** \brief False if there are too many voxels to number. */
  [[nodiscard]] bool usable() const { return axis_bits_ <= most_axis_bits; }
  [[nodiscard]] int key_bits() const { return 3 * axis_bits_; }

  [[nodiscard]] std::uint64_t voxel_of(const Eigen::Vector3f& p) const
  {
    std::uint64_t voxel = 0;
    for (int axis = 0; axis < 3; ++axis)
      voxel = voxel << axis_bits_ | static_cast<std::uint64_t>((static_cast<double>(p[axis]) + 0.5) * voxels_per_unit_);
    return voxel;
  }

 private:
  double voxels_per_unit_;
  int axis_bits_;
};

/** \brief Runs by voxel, those of a voxel by rank. Points follow a Morton curve, so runs are few. */
struct VoxelRuns
{
  PointArray<VoxelRun> runs;
  std::vector<std::size_t> voxel_begin;  ///< first run of every voxel; size voxels + 1

  [[nodiscard]] std::size_t voxels() const { return voxel_begin.size() - 1; }
};

PointArray<VoxelRun> find_runs(const OrderedPoints& points, const VoxelGrid& grid, const Parallel& parallel)
{
  using Runs = std::vector<VoxelRun>;
  const auto find = [&](std::size_t begin, std::size_t end, Runs& runs) {
    for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
      const std::uint64_t voxel = grid.voxel_of(points.position[i]);
      if (runs.empty() || runs.back().voxel != voxel) runs.push_back({voxel, i, i});
      runs.back().end = i + 1;
    }
  };
  return joined(parallel_parts<Runs>(points.size(), block, parallel, find), parallel);
}

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

VoxelRuns group_by_voxel(PointArray<VoxelRun> runs, const VoxelGrid& grid, const Parallel& parallel)
{
  VoxelRuns voxels;
  PointArray<VoxelRun> other(runs.size());
  const VoxelRun* sorted = radix_sort(
      runs.data(), other.data(), runs.size(), {0, grid.key_bits()}, [](const VoxelRun& run) { return run.voxel; },
      parallel);
  voxels.runs = sorted == runs.data() ? std::move(runs) : std::move(other);
  for (std::size_t r = 0; r < voxels.runs.size(); ++r)
    if (r == 0 || voxels.runs[r].voxel != voxels.runs[r - 1].voxel) voxels.voxel_begin.push_back(r);
  voxels.voxel_begin.push_back(voxels.runs.size());
  return voxels;
}

/** \brief The point nearest to the mean of the runs begin ... end. */
std::uint32_t middle_point(const OrderedPoints& points, const VoxelRun* begin, const VoxelRun* end)
{
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  std::size_t count = 0;
  for (const VoxelRun* run = begin; run != end; ++run)
    for (std::uint32_t i = run->begin; i < run->end; ++i, ++count) sum += points.position[i].cast<double>();
  const Eigen::Vector3f mean = (sum / static_cast<double>(count)).cast<float>();
  std::uint32_t middle = begin->begin;
  float least = std::numeric_limits<float>::infinity();
  for (const VoxelRun* run = begin; run != end; ++run)
    for (std::uint32_t i = run->begin; i < run->end; ++i) {
      const float distance = (points.position[i] - mean).squaredNorm();
      if (distance < least) {
        least = distance;
        middle = i;
      }
    }
  return middle;
}

/** \brief For each point, the one that represents it. */
PointArray<std::uint32_t> choose_representatives(const OrderedPoints& points,
                                                 const VoxelRuns& voxels,
                                                 const Parallel& parallel)
{
  PointArray<std::uint32_t> representative(points.size());
  constexpr std::size_t voxels_per_block = 1024;
  parallel.each(voxels.voxels(), voxels_per_block, [&](std::size_t voxel) {
    const VoxelRun* begin = voxels.runs.data() + voxels.voxel_begin[voxel];
    const VoxelRun* end = voxels.runs.data() + voxels.voxel_begin[voxel + 1];
    const std::uint32_t middle = middle_point(points, begin, end);
    for (const VoxelRun* run = begin; run != end; ++run)
      std::fill(representative.begin() + run->begin, representative.begin() + run->end, middle);
  });
  return representative;
}

/** \brief For each block of points, how many representatives come before it; behind the last one, their number. */
std::vector<std::size_t> representatives_before_blocks(const PointArray<std::uint32_t>& representative,
                                                       const Parallel& parallel)
{
  std::vector<std::size_t> before((representative.size() + block - 1) / block + 1);
  parallel.blocks(representative.size(), block, [&](std::size_t begin, std::size_t end, unsigned) {
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) count += representative[i] == i ? 1U : 0U;
    before[begin / block + 1] = count;
  });
  std::partial_sum(before.begin(), before.end(), before.begin());
  return before;
}

/** \brief The points that represent themselves, and all that the others are represented by. */
OrderedPoints keep_representatives(OrderedPoints points,
                                   const PointArray<std::uint32_t>& representative,
                                   const Parallel& parallel)
{
  const std::vector<std::size_t> before = representatives_before_blocks(representative, parallel);
  PointArray<std::uint32_t> new_rank(points.size());
  OrderedPoints left;
  left.position.resize(before.back());
  left.input_index.resize(before.back());
  parallel.blocks(points.size(), block, [&](std::size_t begin, std::size_t end, unsigned) {
    std::size_t next = before[begin / block];
    for (std::size_t i = begin; i < end; ++i) {
      if (representative[i] != i) continue;
      new_rank[i] = static_cast<std::uint32_t>(next);
      left.position[next] = points.position[i];
      left.input_index[next] = points.input_index[i];
      ++next;
    }
  });
  left.rank_of_input = std::move(points.rank_of_input);
  parallel.each(left.rank_of_input.size(), block, [&](std::size_t i) {
    std::uint32_t& rank = left.rank_of_input[i];
    if (rank != no_rank) rank = new_rank[representative[rank]];
  });
  left.origin = points.origin;
  left.unit = points.unit;
  left.valid_points = points.valid_points;
  left.merged_points = points.merged_points;
  left.outliers = points.outliers;
  left.smoothed = points.smoothed;
  left.thinned_points = points.size() - left.size();
  return left;
}

}  // namespace

OrderedPoints thin_points(OrderedPoints points, double voxel_side, const Parallel& parallel)
{
  for (double side = voxel_side; points.size() >= fewest_points_to_thin; side /= 2) {
    const VoxelGrid grid(side);
    if (!grid.usable() || !may_pay(points, grid, parallel)) break;
    const VoxelRuns voxels = group_by_voxel(find_runs(points, grid, parallel), grid, parallel);
    if (!thinning_pays(points.size(), voxels.voxels())) break;
    if (voxels.voxels() < fewest_points_left) continue;
    const PointArray<std::uint32_t> representative = choose_representatives(points, voxels, parallel);
    return keep_representatives(std::move(points), representative, parallel);
  }
  return points;
}

}  // namespace pds
