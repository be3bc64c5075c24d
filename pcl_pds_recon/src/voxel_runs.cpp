// SPDX-License-Identifier: BSD-3-Clause
#include "voxel_runs.h"

#include <vector>
#include "parallel_parts.h"
#include "radix_sort.h"

namespace pds
{
namespace
{

constexpr std::size_t block = 16384;  // points, or runs, per block

PointArray<VoxelRun> find_runs(const PointArray<Eigen::Vector3f>& position,
                               std::size_t first,
                               std::size_t last,
                               const VoxelGrid& grid,
                               const Parallel& parallel)
{
  using Runs = std::vector<VoxelRun>;
  const auto find = [&](std::size_t begin, std::size_t end, Runs& runs) {
    for (auto i = static_cast<std::uint32_t>(first + begin); i < first + end; ++i) {
      const std::uint64_t voxel = grid.voxel_of(position[i]);
      if (runs.empty() || runs.back().voxel != voxel) runs.push_back({voxel, i, i});
      runs.back().end = i + 1;
    }
  };
  return joined(parallel_parts<Runs>(last - first, block, parallel, find), parallel);
}

}  // namespace

VoxelRuns::VoxelRuns(const PointArray<Eigen::Vector3f>& position,
                     std::size_t begin,
                     std::size_t end,
                     const VoxelGrid& grid,
                     const Parallel& parallel)
    : runs_(find_runs(position, begin, end, grid, parallel))
{
  PointArray<VoxelRun> other(runs_.size());
  const VoxelRun* sorted = radix_sort(
      runs_.data(), other.data(), runs_.size(), {0, grid.key_bits()}, [](const VoxelRun& run) { return run.voxel; },
      parallel);
  if (sorted != runs_.data()) runs_.swap(other);
  using Begins = std::vector<std::uint32_t>;
  const auto find = [&](std::size_t first, std::size_t last, Begins& begins) {
    for (std::size_t r = first; r < last; ++r)
      if (r == 0 || runs_[r].voxel != runs_[r - 1].voxel) begins.push_back(static_cast<std::uint32_t>(r));
  };
  voxel_begin_ = joined(parallel_parts<Begins>(runs_.size(), block, parallel, find), parallel);
  voxel_begin_.push_back(static_cast<std::uint32_t>(runs_.size()));
}

}  // namespace pds
