// SPDX-License-Identifier: BSD-3-Clause
#include "cell_schedule.h"

#include <algorithm>
#include <cmath>
#include "parallel_parts.h"
#include "radix_sort.h"

namespace pds
{
namespace
{

constexpr std::size_t axes = 3;
constexpr int side_bits = 2;
constexpr std::uint64_t side = 1U << side_bits;  // of a cell, in blocks
constexpr int place_bits = axes * side_bits;     // of a block's place in its cell
constexpr std::uint64_t place_mask = CellSchedule::blocks_per_cell - 1;
static_assert(side * side * side == CellSchedule::blocks_per_cell, "numbers end in a block's place in its cell");

using Step = std::array<int, axes>;  // to a cell beside, -1 ... 1 along each axis
constexpr int step_width = 3;
constexpr int steps = step_width * step_width * step_width;

constexpr Step step_of(int number)
{
  return {number / (step_width * step_width) - 1, number / step_width % step_width - 1, number % step_width - 1};
}

/** \brief Coordinate of a block within its cell. */
constexpr std::uint64_t along(std::size_t axis, std::uint64_t place)
{
  return place >> ((axes - 1 - axis) * side_bits) & (side - 1);
}

/** \brief By axis, step and coordinate of a block along it: a bit for each of the 64 blocks of the cell that lies that
 * step away whose coordinate differs by no more than one. */
using NearAlong = std::array<std::array<std::array<std::uint64_t, side>, step_width>, axes>;

constexpr NearAlong near_along_all()
{
  NearAlong near{};
  for (std::size_t axis = 0; axis < axes; ++axis)
    for (std::uint64_t step = 0; step < step_width; ++step)
      for (std::uint64_t here = 0; here < side; ++here)
        for (std::uint64_t place = 0; place <= place_mask; ++place) {
          const std::uint64_t there = along(axis, place) + step * side;  // the cell itself is a step of one
          if (there + 1 >= here + side && there <= here + side + 1) near[axis][step][here] |= std::uint64_t{1} << place;
        }
  return near;
}

constexpr NearAlong near_along = near_along_all();

/** \brief Of the 64 blocks of the cell that lies a step away, a bit for each that touches one of these. */
std::uint64_t touching_blocks(const Step& step, std::uint64_t blocks)
{
  std::uint64_t touching = 0;
  for (std::uint64_t place = 0; blocks != 0; ++place, blocks >>= 1) {
    if ((blocks & 1) == 0) continue;
    std::uint64_t near = ~std::uint64_t{0};
    for (std::size_t axis = 0; axis < axes; ++axis) {
      const int step_number = step[axis] + 1;
      near &= near_along[axis][static_cast<std::size_t>(step_number)][along(axis, place)];
    }
    touching |= near;
  }
  return touching;
}

/** \brief Keys of cells: the colour, which is the parity of its coordinates, then these. */
class CellKeys
{
 public:
  explicit CellKeys(int axis_bits) : axis_bits_(static_cast<unsigned>(axis_bits)), mask_((1ULL << axis_bits) - 1) {}

  [[nodiscard]] std::uint64_t key(const std::array<std::uint64_t, axes>& cell) const
  {
    std::uint64_t color = 0;
    std::uint64_t place = 0;
    for (const std::uint64_t along : cell) {
      color = color << 1 | (along & 1);
      place = place << axis_bits_ | (along & mask_);
    }
    return color << (axes * axis_bits_) | place;
  }
  [[nodiscard]] std::uint64_t next_to(std::uint64_t key_of_cell, const Step& step) const
  {
    std::array<std::uint64_t, axes> next{};
    for (std::size_t axis = 0; axis < axes; ++axis)
      next[axis] = (key_of_cell >> ((axes - 1 - axis) * axis_bits_)) + static_cast<std::uint64_t>(step[axis]);
    return key(next);
  }
  [[nodiscard]] std::size_t color_of(std::uint64_t key_of_cell) const { return key_of_cell >> (axes * axis_bits_); }

 private:
  unsigned axis_bits_;
  std::uint64_t mask_;
};

}  // namespace

/** \brief Numbers blocks: the key of the cell, then the block's place in it. */
class CellSchedule::Grid
{
 public:
  // The quotient of a coordinate, which is below 1, and the side must fit an integer.
  explicit Grid(double block_side)
      : blocks_per_unit_(1 / std::max(block_side, std::ldexp(1.0, -60))), keys_(axis_bits())
  {
  }

  /** \brief As many as all cells take and one beyond them on either side, for nothing is beside the last one; but no
   * more than fit into the key. It does no harm if cells that far apart take their turn together. */
  [[nodiscard]] int axis_bits() const
  {
    constexpr int most_axis_bits = 18;
    return std::min(std::ilogb(blocks_per_unit_ / side + 4) + 1, most_axis_bits);
  }

  [[nodiscard]] std::uint64_t block_of(const Eigen::Vector3f& p) const
  {
    std::array<std::uint64_t, axes> cell{};
    std::uint64_t place = 0;
    for (int axis = 0; axis < static_cast<int>(axes); ++axis) {
      const double along = (static_cast<double>(p[axis]) + 0.5) * blocks_per_unit_;
      const auto block = static_cast<std::uint64_t>(static_cast<std::int64_t>(along)) + side;
      cell[static_cast<std::size_t>(axis)] = block >> side_bits;
      place = place << side_bits | (block & (side - 1));
    }
    return keys_.key(cell) << place_bits | place;
  }

 private:
  double blocks_per_unit_;
  CellKeys keys_;
};

CellSchedule::CellSchedule(const OrderedPoints& points, double block_side, const Parallel& parallel) : axis_bits_(0)
{
  const Grid grid(block_side);
  axis_bits_ = grid.axis_bits();
  collect_runs(points, grid, parallel);
  const CellKeys keys(axis_bits_);
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const std::uint64_t cell = runs_[r].block >> place_bits;
    if (r > 0 && cell == cell_.back()) continue;
    cell_.push_back(cell);
    run_begin_.push_back(r);
    for (std::size_t color = keys.color_of(cell) + 1; color <= color_count; ++color) color_begin_[color] = cell_.size();
  }
  run_begin_.push_back(runs_.size());
}

void CellSchedule::collect_runs(const OrderedPoints& points, const Grid& grid, const Parallel& parallel)
{
  constexpr std::size_t points_per_task = 16384;
  using Runs = std::vector<BlockRun>;
  const auto collect = [&](std::size_t begin, std::size_t end, Runs& runs) {
    for (auto point = static_cast<std::uint32_t>(begin); point < end; ++point) {
      const std::uint64_t block = grid.block_of(points.position[point]);
      if (runs.empty() || runs.back().block != block) runs.push_back({block, {point, point}});
      runs.back().points.end = point + 1;
    }
  };
  runs_ = joined(parallel_parts<Runs>(points.size(), points_per_task, parallel, collect), parallel);
  PointArray<BlockRun> other(runs_.size());
  const int key_bits = static_cast<int>(axes) * (axis_bits_ + 1);
  const BlockRun* sorted = radix_sort(
      runs_.data(), other.data(), runs_.size(), {place_bits, key_bits}, [](const BlockRun& run) { return run.block; },
      parallel);
  if (sorted != runs_.data()) runs_.swap(other);
}

/** \brief The number of a cell; that behind the last one if it is empty. */
std::size_t CellSchedule::find(std::uint64_t key) const
{
  const std::size_t color = CellKeys(axis_bits_).color_of(key);
  const auto begin = cell_.begin() + static_cast<std::ptrdiff_t>(first_cell(color));
  const auto end = cell_.begin() + static_cast<std::ptrdiff_t>(last_cell(color));
  const auto place = std::lower_bound(begin, end, key);
  return place != end && *place == key ? static_cast<std::size_t>(place - cell_.begin()) : cell_.size();
}

void CellSchedule::append_surroundings(std::size_t cell, std::uint64_t blocks, std::vector<RankRange>& patch) const
{
  const CellKeys keys(axis_bits_);
  for (int number = 0; number < steps; ++number) {
    const Step step = step_of(number);
    const std::uint64_t touching = touching_blocks(step, blocks);
    if (touching == 0) continue;
    const std::size_t next = find(keys.next_to(cell_[cell], step));
    if (next == cell_.size()) continue;
    for (std::size_t r = run_begin_[next]; r < run_begin_[next + 1]; ++r) {
      const RankRange& points = runs_[r].points;
      if ((touching >> (runs_[r].block & place_mask) & 1) == 0) continue;
      if (!patch.empty() && patch.back().end == points.begin)
        patch.back().end = points.end;
      else
        patch.push_back(points);
    }
  }
}

}  // namespace pds
