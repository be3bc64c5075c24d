// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/geodesic_disk.h>
#include <pcl_pds_recon/poisson_disk_sampling.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <tuple>

namespace pds
{
namespace
{

constexpr std::size_t color_count = 8;  // 2 x 2 x 2: cells of one colour are a whole cell apart

/** \brief A point's turn: by colour, then cell, then descending feature rank, then drawn lot. */
struct Dart
{
  std::uint64_t cell;  ///< colour in the top bits
  std::uint64_t lot;   ///< complement of the feature rank in the top bits
  std::uint32_t point;

  bool operator<(const Dart& other) const
  {
    return std::tie(cell, lot, point) < std::tie(other.cell, other.lot, other.point);
  }
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

/** \brief Colour and number of the cell that holds \a p. Numbers repeat every 2^20 cells along an axis: cells that
 * share one are far apart, and it does no harm that they take their turn together. */
std::uint64_t cell_of(const Eigen::Vector3f& p, double cell_side)
{
  constexpr int axis_bits = 20;
  constexpr std::uint64_t axis_mask = (std::uint64_t{1} << axis_bits) - 1;
  const double side = std::max(cell_side, std::ldexp(1.0, -60));  // the quotient must fit an integer
  std::uint64_t cell = 0;
  std::uint64_t color = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double coordinate = std::floor(static_cast<double>(p[axis]) / side);
    const auto number = static_cast<std::uint64_t>(static_cast<std::int64_t>(coordinate)) & axis_mask;
    cell = cell << axis_bits | number;
    color = color << 1 | (number & 1);
  }
  return color << (3 * axis_bits) | cell;
}

std::vector<Dart> sorted_darts(const OrderedPoints& points,
                               const std::vector<std::uint8_t>& feature_rank,
                               double cell_side,
                               std::uint64_t seed,
                               const Parallel& parallel)
{
  constexpr std::size_t block = 16384;
  constexpr int rank_bits = 4;
  std::vector<Dart> darts(points.size());
  parallel.each(points.size(), block, [&](std::size_t i) {
    const std::uint64_t lot = hash_position(points.position[i], seed) >> rank_bits;
    const std::uint64_t turn = std::uint64_t{15U - feature_rank[i]} << (64 - rank_bits);
    darts[i] = {cell_of(points.position[i], cell_side), turn | lot, static_cast<std::uint32_t>(i)};
  });
  std::sort(darts.begin(), darts.end());
  return darts;
}

/** \brief Begin of each cell's darts, and of each colour's cells. */
struct Schedule
{
  std::vector<std::size_t> cell_begin;
  std::array<std::size_t, color_count + 1> color_begin{};
};

Schedule schedule_cells(const std::vector<Dart>& darts)
{
  constexpr int color_shift = 60;
  Schedule schedule;
  for (std::size_t i = 0; i < darts.size(); ++i)
    if (i == 0 || darts[i].cell != darts[i - 1].cell) {
      schedule.cell_begin.push_back(i);
      for (std::size_t color = (darts[i].cell >> color_shift) + 1; color <= color_count; ++color)
        schedule.color_begin[color] = schedule.cell_begin.size();
    }
  schedule.cell_begin.push_back(darts.size());
  return schedule;
}

/** \brief Throws one dart: a seed, unless its own disk shows that an earlier seed is within the radius after all. */
void throw_dart(std::uint32_t point, float radius, GeodesicDisk& disk, std::vector<NearestSeeds>& nearest)
{
  if (nearest[point].covered(radius)) return;
  const auto& reached = disk.grow(point, static_cast<float>(disk_reach) * radius);
  for (const GeodesicDisk::Reached& r : reached) {
    if (r.distance > radius) break;
    if (nearest[r.point].seed[0] == r.point) {
      nearest[point].insert(r.point, r.distance);
      return;
    }
  }
  for (const GeodesicDisk::Reached& r : reached) nearest[r.point].insert(point, r.distance);
}

}  // namespace

void NearestSeeds::insert(std::uint32_t new_seed, float new_distance)
{
  if (new_distance >= distance[capacity - 1]) return;
  // A seed stands here once: its entry moves forward, or the last one makes room.
  std::size_t place = 0;
  while (place + 1 < capacity && seed[place] != new_seed) ++place;
  if (seed[place] == new_seed && distance[place] <= new_distance) return;
  for (; place > 0 && distance[place - 1] > new_distance; --place) {
    distance[place] = distance[place - 1];
    seed[place] = seed[place - 1];
  }
  distance[place] = new_distance;
  seed[place] = new_seed;
}

PoissonDiskSampling sample_poisson_disks(const OrderedPoints& points,
                                         const NeighborGraph& graph,
                                         const EdgeWeights& weights,
                                         const std::vector<std::uint8_t>& feature_rank,
                                         double radius,
                                         GeodesicSolver solver,
                                         std::uint64_t seed,
                                         const Parallel& parallel)
{
  PoissonDiskSampling sampling;
  sampling.radius = radius;
  sampling.nearest.resize(points.size());
  constexpr double rounding_margin = 1.001;  // distances and cell borders are rounded to single precision
  const std::vector<Dart> darts =
      sorted_darts(points, feature_rank, 2 * disk_reach * radius * rounding_margin, seed, parallel);
  const Schedule schedule = schedule_cells(darts);

  constexpr std::size_t cells_per_block = 4;
  for (std::size_t color = 0; color < color_count; ++color) {
    const std::size_t first = schedule.color_begin[color];
    const std::size_t cells = schedule.color_begin[color + 1] - first;
    parallel.blocks(cells, cells_per_block, [&](std::size_t begin, std::size_t end, unsigned) {
      GeodesicDisk disk(points, graph, weights, solver);
      for (std::size_t d = schedule.cell_begin[first + begin]; d < schedule.cell_begin[first + end]; ++d)
        throw_dart(darts[d].point, static_cast<float>(radius), disk, sampling.nearest);
    });
  }

  // A seed is its own nearest seed. From here on seeds are named by their place among the seeds.
  std::vector<std::uint32_t> seed_of_point(points.size(), NearestSeeds::none);
  for (std::uint32_t i = 0; i < points.size(); ++i)
    if (sampling.nearest[i].seed[0] == i) {
      seed_of_point[i] = static_cast<std::uint32_t>(sampling.seeds.size());
      sampling.seeds.push_back(i);
    }
  constexpr std::size_t block = 16384;
  parallel.each(points.size(), block, [&](std::size_t i) {
    for (std::uint32_t& s : sampling.nearest[i].seed)
      if (s != NearestSeeds::none) s = seed_of_point[s];
  });
  return sampling;
}

}  // namespace pds
