// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/thinning.h>

#include <algorithm>
#include <cmath>
#include "radix_sort.h"

namespace pds
{
namespace
{

constexpr std::size_t block = 16384;      // points per block
constexpr int most_axis_bits = 21;        // of a voxel's number along an axis; three fit a 64-bit key
constexpr double least_gain = 2.0;        // points per voxel; thinning by less does not pay
constexpr std::size_t least_left = 1000;  // points; fewer say nothing about a surface, however large the radius
constexpr double least_run_gain = 1.3;    // points per run; where runs are shorter, voxels hold hardly two points

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
  std::vector<VoxelRun> runs;
  std::vector<std::size_t> voxel_begin;  ///< first run of every voxel; size voxels + 1

  [[nodiscard]] std::size_t voxels() const { return voxel_begin.size() - 1; }
};

std::vector<VoxelRun> find_runs(const OrderedPoints& points, const VoxelGrid& grid, const Parallel& parallel)
{
  std::vector<std::vector<VoxelRun>> runs_of_block((points.size() + block - 1) / block);
  parallel.blocks(points.size(), block, [&](std::size_t begin, std::size_t end, unsigned) {
    std::vector<VoxelRun>& runs = runs_of_block[begin / block];
    for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i) {
      const std::uint64_t voxel = grid.voxel_of(points.position[i]);
      if (runs.empty() || runs.back().voxel != voxel) runs.push_back({voxel, i, i});
      runs.back().end = i + 1;
    }
  });
  std::vector<VoxelRun> all;
  for (const std::vector<VoxelRun>& runs : runs_of_block) all.insert(all.end(), runs.begin(), runs.end());
  return all;
}

VoxelRuns group_by_voxel(std::vector<VoxelRun> runs, const VoxelGrid& grid, const Parallel& parallel)
{
  VoxelRuns voxels;
  std::vector<VoxelRun> other(runs.size());
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
std::vector<std::uint32_t> choose_representatives(const OrderedPoints& points,
                                                  const VoxelRuns& voxels,
                                                  const Parallel& parallel)
{
  std::vector<std::uint32_t> representative(points.size());
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

/** \brief The points that represent themselves, and all that the others are represented by. */
OrderedPoints keep_representatives(OrderedPoints points,
                                   const std::vector<std::uint32_t>& representative,
                                   std::size_t kept,
                                   const Parallel& parallel)
{
  std::vector<std::uint32_t> new_rank(points.size());
  OrderedPoints left;
  left.position.reserve(kept);
  left.input_index.reserve(kept);
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (representative[i] != i) continue;
    new_rank[i] = static_cast<std::uint32_t>(left.position.size());
    left.position.push_back(points.position[i]);
    left.input_index.push_back(points.input_index[i]);
  }
  left.rank_of_input = std::move(points.rank_of_input);
  parallel.each(left.rank_of_input.size(), block, [&](std::size_t i) {
    std::uint32_t& rank = left.rank_of_input[i];
    if (rank != no_rank) rank = new_rank[representative[rank]];
  });
  left.origin = points.origin;
  left.unit = points.unit;
  left.valid_points = points.valid_points;
  left.merged_points = points.merged_points;
  left.thinned_points = points.size() - left.size();
  return left;
}

}  // namespace

OrderedPoints thin_points(OrderedPoints points, double voxel_side, const Parallel& parallel)
{
  const auto n = static_cast<double>(points.size());
  for (double side = voxel_side; points.size() >= 2 * least_left; side /= 2) {
    const VoxelGrid grid(side);
    if (!grid.usable()) break;
    std::vector<VoxelRun> runs = find_runs(points, grid, parallel);
    if (n < least_run_gain * static_cast<double>(runs.size())) break;
    const VoxelRuns voxels = group_by_voxel(std::move(runs), grid, parallel);
    if (n < least_gain * static_cast<double>(voxels.voxels())) break;
    if (voxels.voxels() < least_left) continue;
    const std::vector<std::uint32_t> representative = choose_representatives(points, voxels, parallel);
    return keep_representatives(std::move(points), representative, voxels.voxels(), parallel);
  }
  return points;
}

}  // namespace pds
