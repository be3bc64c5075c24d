// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pcl_pds_recon/geodesic_disk.h>
#include <pcl_pds_recon/ordered_points.h>
#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/point_array.h>

namespace pds
{

/** \brief Space cut into cells of 4 x 4 x 4 blocks, and the points in them.
 *
 * A block is as wide as a disk reaches, so that the disks of a cell stay within the blocks next to it, and those of
 * different cells of one of the 2 x 2 x 2 colours have no block in common: all cells of a colour can be worked on at
 * the same time. Cells of two blocks a side would do for that, but what surrounds them would be three times as much as
 * they hold.
 */
class CellSchedule
{
 public:
  static constexpr std::size_t color_count = 8;
  static constexpr std::uint64_t blocks_per_cell = 64;

  /** \param block_side in units of position, which are within [-0.5, 0.5] */
  CellSchedule(const OrderedPoints& points, double block_side, const Parallel& parallel);

  ///@{
  /** \brief Numbers of the first and behind the last cell of a colour. */
  [[nodiscard]] std::size_t first_cell(std::size_t color) const { return color_begin_[color]; }
  [[nodiscard]] std::size_t last_cell(std::size_t color) const { return color_begin_[color + 1]; }
  ///@}

  /** \brief Calls visit(range, block) for the points of a cell; they are in one of its 64 blocks, of which \a block is
   * the bit. */
  template <typename Visit>
  void visit_points(std::size_t cell, const Visit& visit) const
  {
    for (std::size_t run = run_begin_[cell]; run < run_begin_[cell + 1]; ++run)
      visit(runs_[run].points, std::uint64_t{1} << runs_[run].block % blocks_per_cell);
  }

  /** \brief Appends the points of some blocks of a cell and of those next to them, in the same cell or another.
   * \param blocks a bit for each */
  void append_surroundings(std::size_t cell, std::uint64_t blocks, std::vector<RankRange>& patch) const;

 private:
  /** \brief Consecutive points in the same block. Points follow a Morton curve, so runs are long. */
  struct BlockRun
  {
    std::uint64_t block;
    RankRange points;
  };
  class Grid;

  void collect_runs(const OrderedPoints& points, const Grid& grid, const Parallel& parallel);
  [[nodiscard]] std::size_t find(std::uint64_t key) const;

  int axis_bits_;                       ///< of a cell's place along an axis
  PointArray<BlockRun> runs_;           ///< by cell, those of a cell by points
  std::vector<std::uint64_t> cell_;     ///< keys, ascending, so by colour
  std::vector<std::size_t> run_begin_;  ///< begin of each cell's runs; size cells + 1
  std::array<std::size_t, color_count + 1> color_begin_{};
};

}  // namespace pds
