// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/geodesic_disk.h>
#include <pcl_pds_recon/poisson_disk_sampling.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <tuple>
#include "parallel_parts.h"

namespace pds
{
namespace
{

constexpr std::size_t color_count = 8;  // 2 x 2 x 2: cells of one colour are a whole cell apart

/** \brief Consecutive points that lie in the same block. */
struct BlockRun
{
  std::uint64_t block;
  RankRange points;

  bool operator<(const BlockRun& other) const
  {
    return block != other.block ? block < other.block : points.begin < other.points.begin;
  }
};

/** \brief A point's turn within its cell: by descending feature rank, then by drawn lot. */
struct Dart
{
  std::uint64_t turn;
  std::uint32_t point;

  bool operator<(const Dart& other) const { return std::tie(turn, point) < std::tie(other.turn, other.point); }
};

/** \brief Finaliser of the SplitMix64 generator: every input bit changes about half of the output bits. */
std::uint64_t mix(std::uint64_t v)
{
  v = (v ^ (v >> 30)) * 0xbf58476d1ce4e5b9ULL;
  v = (v ^ (v >> 27)) * 0x94d049bb133111ebULL;
  return v ^ (v >> 31);
}

std::uint64_t hash_position(const Eigen::Vector3f& p, std::uint64_t seed)
{
  std::uint64_t hash = mix(seed + 0x9e3779b97f4a7c15ULL);
  for (int axis = 0; axis < 3; ++axis) {
    std::uint32_t bits;
    const float coordinate = p[axis] + 0.0F;  // turns -0 into +0
    std::memcpy(&bits, &coordinate, sizeof bits);
    hash = mix(hash ^ bits) + 0x9e3779b97f4a7c15ULL;
  }
  return hash;
}

/** \brief Space cut into cells of 4 x 4 x 4 blocks. A block is as wide as a disk reaches, so that the disks of a cell
 * stay within the blocks next to it, and those of different cells of one colour have no block in common. Cells of two
 * blocks a side would do for that, but what surrounds them would be three times as much as they hold.
 *
 * A block's number has its cell's colour in the top bits, then the cell, then its place in the cell. Coordinates repeat
 * every 2^20 blocks along an axis: it does no harm that cells far apart take their turn together.
 */
class BlockGrid
{
 public:
  // The quotient of a coordinate, which is below 1, and the side must fit an integer.
  explicit BlockGrid(double block_side) : blocks_per_unit_(1 / std::max(block_side, std::ldexp(1.0, -60))) {}

  [[nodiscard]] std::uint64_t block_of(const Eigen::Vector3f& p) const
  {
    std::uint64_t cell = 0;
    std::uint64_t place = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double coordinate = static_cast<double>(p[axis]) * blocks_per_unit_;
      auto floor = static_cast<std::int64_t>(coordinate);
      floor -= static_cast<double>(floor) > coordinate ? 1 : 0;
      const auto block = static_cast<std::uint64_t>(floor);
      cell = cell << axis_bits | (block >> side_bits & axis_mask);
      place = place << side_bits | (block & (side - 1));
    }
    return number_of(cell) << place_bits | place;
  }

  static std::uint64_t cell_of(std::uint64_t block) { return block >> place_bits; }
  static std::size_t color_of(std::uint64_t cell) { return cell >> (3 * axis_bits); }

  /** \brief The number of the cell that lies dx, dy, dz cells away. */
  static std::uint64_t next_to(std::uint64_t cell, const std::array<int, 3>& step)
  {
    std::uint64_t next = 0;
    for (std::size_t axis = 0; axis < 3; ++axis)
      next = next << axis_bits | ((coordinate(cell, axis) + static_cast<std::uint64_t>(step[axis])) & axis_mask);
    return number_of(next);
  }

  /** \brief True if a block of the cell that lies a step away touches the cell it was made from. */
  static bool touches(std::uint64_t block, const std::array<int, 3>& step)
  {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const std::uint64_t along = block >> ((2 - axis) * side_bits) & (side - 1);
      if ((step[axis] < 0 && along != side - 1) || (step[axis] > 0 && along != 0)) return false;
    }
    return true;
  }

 private:
  static constexpr int side_bits = 2;
  static constexpr std::uint64_t side = 1U << side_bits;  ///< of a cell, in blocks
  static constexpr int place_bits = 3 * side_bits;
  static constexpr int axis_bits = 18;
  static constexpr std::uint64_t axis_mask = (std::uint64_t{1} << axis_bits) - 1;

  static std::uint64_t coordinate(std::uint64_t cell, std::size_t axis)
  {
    return cell >> ((2 - axis) * axis_bits) & axis_mask;
  }

  /** \brief The colour, from the parity of the coordinates, put in front of them. */
  static std::uint64_t number_of(std::uint64_t coordinates)
  {
    std::uint64_t color = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) color = color << 1 | (coordinate(coordinates, axis) & 1);
    return color << (3 * axis_bits) | coordinates;
  }

  double blocks_per_unit_;
};

/** \brief The runs of every cell, and the cells of every colour. Points follow a Morton curve, so runs are long. */
class Schedule
{
 public:
  Schedule(const OrderedPoints& points, const BlockGrid& grid, const Parallel& parallel)
  {
    collect_runs(points, grid, parallel);
    std::sort(runs_.begin(), runs_.end());
    for (std::size_t r = 0; r < runs_.size(); ++r) {
      const std::uint64_t cell = BlockGrid::cell_of(runs_[r].block);
      if (r > 0 && cell == cell_.back()) continue;
      cell_.push_back(cell);
      run_begin_.push_back(r);
      for (std::size_t color = BlockGrid::color_of(cell) + 1; color <= color_count; ++color)
        color_begin_[color] = cell_.size();
    }
    run_begin_.push_back(runs_.size());
  }

  /** \brief Numbers of the first and behind the last cell of a colour. */
  [[nodiscard]] std::size_t first_cell(std::size_t color) const { return color_begin_[color]; }
  [[nodiscard]] std::size_t last_cell(std::size_t color) const { return color_begin_[color + 1]; }
  [[nodiscard]] const BlockRun* runs_begin(std::size_t cell) const { return runs_.data() + run_begin_[cell]; }
  [[nodiscard]] const BlockRun* runs_end(std::size_t cell) const { return runs_.data() + run_begin_[cell + 1]; }

  /** \brief Appends the points of a cell and of the blocks next to it. */
  void append_surroundings(std::size_t number, std::vector<RankRange>& patch) const
  {
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        for (int dz = -1; dz <= 1; ++dz) {
          const std::array<int, 3> step{dx, dy, dz};
          const std::size_t next = find(BlockGrid::next_to(cell_[number], step));
          if (next == none) continue;
          for (const BlockRun* run = runs_begin(next); run != runs_end(next); ++run)
            if (BlockGrid::touches(run->block, step)) patch.push_back(run->points);
        }
  }

 private:
  static constexpr std::size_t none = ~std::size_t{0};

  /** \brief The place of a cell in the list; none if it is empty. */
  [[nodiscard]] std::size_t find(std::uint64_t wanted) const
  {
    const std::size_t color = BlockGrid::color_of(wanted);
    const auto begin = cell_.begin() + static_cast<std::ptrdiff_t>(first_cell(color));
    const auto end = cell_.begin() + static_cast<std::ptrdiff_t>(last_cell(color));
    const auto place = std::lower_bound(begin, end, wanted);
    return place != end && *place == wanted ? static_cast<std::size_t>(place - cell_.begin()) : none;
  }

  void collect_runs(const OrderedPoints& points, const BlockGrid& grid, const Parallel& parallel)
  {
    constexpr std::size_t points_per_task = 16384;
    using Runs = std::vector<BlockRun>;
    const auto find = [&](std::size_t begin, std::size_t end, Runs& runs) {
      for (auto point = static_cast<std::uint32_t>(begin); point < end; ++point) {
        const std::uint64_t block = grid.block_of(points.position[point]);
        if (runs.empty() || runs.back().block != block) runs.push_back({block, {point, point}});
        runs.back().points.end = point + 1;
      }
    };
    runs_ = joined(parallel_parts<Runs>(points.size(), points_per_task, parallel, find), parallel);
  }

  PointArray<BlockRun> runs_;           ///< by block, then points
  std::vector<std::uint64_t> cell_;     ///< numbers, ascending, so by colour
  std::vector<std::size_t> run_begin_;  ///< begin of each cell's runs; size cells + 1
  std::array<std::size_t, color_count + 1> color_begin_{};
};

/** \brief Throws the darts of one cell after the other. Holds the working memory of one thread. */
class DartThrower
{
 public:
  DartThrower(const OrderedPoints& points,
              const std::vector<std::uint8_t>& feature_rank,
              std::uint64_t seed,
              const Schedule& schedule,
              GeodesicDisk& disk,
              PoissonDiskSampling& sampling)
      : points_(points),
        feature_rank_(feature_rank),
        seed_(seed),
        schedule_(schedule),
        disk_(disk),
        radius_(static_cast<float>(sampling.radius)),
        nearest_(sampling.nearest)
  {
  }

  /** \brief Makes seeds of the given points in a cell, however close to others they are. */
  void place_given(std::size_t cell, const std::vector<std::uint32_t>& given)
  {
    darts_.clear();
    for (const BlockRun* run = schedule_.runs_begin(cell); run != schedule_.runs_end(cell); ++run)
      for (auto g = std::lower_bound(given.begin(), given.end(), run->points.begin);
           g != given.end() && *g < run->points.end; ++g)
        darts_.push_back({*g, *g});
    if (darts_.empty()) return;
    enter(cell);
    for (const Dart& dart : darts_) place_seed(dart.point, grow(dart.point));
  }

  /** \param coverage in radii: points are darts that are farther from all seeds
   * \param least_rank and of this feature rank or a higher one */
  void throw_darts(std::size_t cell, double coverage, std::uint8_t least_rank)
  {
    const float covered = static_cast<float>(coverage) * radius_;
    darts_.clear();
    for (const BlockRun* run = schedule_.runs_begin(cell); run != schedule_.runs_end(cell); ++run)
      for (std::uint32_t point = run->points.begin; point < run->points.end; ++point)
        if (feature_rank_[point] >= least_rank && !nearest_[point].covered(covered))
          darts_.push_back({turn_of(point), point});
    if (darts_.empty()) return;
    std::sort(darts_.begin(), darts_.end());
    enter(cell);
    for (const Dart& dart : darts_)
      if (!nearest_[dart.point].covered(covered)) throw_dart(dart.point);
  }

 private:
  using Disk = std::vector<GeodesicDisk::Reached>;

  void enter(std::size_t cell)
  {
    patch_.clear();
    schedule_.append_surroundings(cell, patch_);
    disk_.enter(patch_);
  }

  const Disk& grow(std::uint32_t point) { return disk_.grow(point, static_cast<float>(disk_reach) * radius_); }

  void place_seed(std::uint32_t point, const Disk& disk)
  {
    // Its own entry comes first, whatever disks cover it already.
    for (const GeodesicDisk::Reached& r : disk)
      if (r.point != point) nearest_[r.point].insert(point, r.distance);
    nearest_[point].insert(point, 0.0F);
  }

  [[nodiscard]] std::uint64_t turn_of(std::uint32_t point) const
  {
    constexpr int rank_bits = 8;
    const std::uint64_t lot = hash_position(points_.position[point], seed_) >> rank_bits;
    return std::uint64_t{255U - feature_rank_[point]} << (64 - rank_bits) | lot;
  }

  /** \brief A dart becomes a seed, unless its own disk shows that an earlier seed is within the radius after all. */
  void throw_dart(std::uint32_t point)
  {
    const Disk& reached = grow(point);
    GeodesicDisk::Reached nearest_seed{NearestSeeds::none, radius_};
    for (const GeodesicDisk::Reached& r : reached)
      if (r.distance <= nearest_seed.distance && nearest_[r.point].seed[0] == r.point &&
          (r.distance < nearest_seed.distance || r.point < nearest_seed.point))
        nearest_seed = r;
    if (nearest_seed.point == NearestSeeds::none)
      place_seed(point, reached);
    else
      nearest_[point].insert_or_approach(nearest_seed.point, nearest_seed.distance);
  }

  const OrderedPoints& points_;
  const std::vector<std::uint8_t>& feature_rank_;
  std::uint64_t seed_;
  const Schedule& schedule_;
  GeodesicDisk& disk_;
  float radius_;
  PointArray<NearestSeeds>& nearest_;
  std::vector<Dart> darts_;
  std::vector<RankRange> patch_;
};

/** \brief Lists the seeds, and names them by their place in that list wherever they were named by their point. */
void number_seeds(PoissonDiskSampling& sampling, const Parallel& parallel)
{
  const std::size_t n = sampling.nearest.size();
  std::vector<std::uint32_t> seed_of_point(n, NearestSeeds::none);
  for (std::uint32_t i = 0; i < n; ++i)
    if (sampling.nearest[i].seed[0] == i) {
      seed_of_point[i] = static_cast<std::uint32_t>(sampling.seeds.size());
      sampling.seeds.push_back(i);
    }
  constexpr std::size_t block = 16384;
  parallel.each(n, block, [&](std::size_t i) {
    for (std::uint32_t& s : sampling.nearest[i].seed)
      if (s != NearestSeeds::none) s = seed_of_point[s];
  });
}

}  // namespace

PoissonDiskSampling sample_poisson_disks(const OrderedPoints& points,
                                         const NeighborGraph& graph,
                                         const SurfaceEstimate& surface,
                                         const EdgeWeights& weights,
                                         const std::vector<std::uint8_t>& feature_rank,
                                         double radius,
                                         GeodesicSolver solver,
                                         std::uint64_t seed,
                                         const Parallel& parallel,
                                         const GivenSeeds& given)
{
  PoissonDiskSampling sampling;
  sampling.radius = radius;
  sampling.nearest.resize(points.size());
  {
    // The working memory of the darts is gone before the seeds are numbered.
    constexpr double rounding_margin = 1.001;  // distances and block borders are rounded to single precision
    const Schedule schedule(points, BlockGrid(disk_reach * radius * rounding_margin), parallel);
    PatchMarks marks(points.size());
    constexpr std::size_t cells_per_block = 4;
    const auto each_cell = [&](const auto& action) {
      for (std::size_t color = 0; color < color_count; ++color) {
        const std::size_t first = schedule.first_cell(color);
        parallel.blocks(schedule.last_cell(color) - first, cells_per_block,
                        [&](std::size_t begin, std::size_t end, unsigned) {
                          GeodesicDisk disk(points, graph, surface, weights, solver, marks);
                          DartThrower thrower(points, feature_rank, seed, schedule, disk, sampling);
                          for (std::size_t cell = first + begin; cell < first + end; ++cell) action(thrower, cell);
                        });
      }
    };
    if (!given.ranks.empty())
      each_cell([&](DartThrower& thrower, std::size_t cell) { thrower.place_given(cell, given.ranks); });
    for (const std::uint8_t least_rank : {crease_rank, std::uint8_t{0}})
      each_cell([&](DartThrower& thrower, std::size_t cell) { thrower.throw_darts(cell, given.coverage, least_rank); });
  }
  number_seeds(sampling, parallel);
  return sampling;
}

}  // namespace pds
