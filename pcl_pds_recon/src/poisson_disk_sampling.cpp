// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/geodesic_disk.h>
#include <pcl_pds_recon/poisson_disk_sampling.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <tuple>
#include <utility>
#include "cell_schedule.h"
#include "parallel_parts.h"

namespace pds
{
namespace
{

constexpr std::size_t block = 16384;  // points per block

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

/** \brief Hands out the darts of a cell by turn: sorted into a few buckets first, and each of these only when it comes
 * up, for most of its darts are covered by then and need no place in the order. */
class DartQueue
{
 public:
  void clear() { darts_.clear(); }
  void add(const Dart& dart) { darts_.push_back(dart); }
  [[nodiscard]] bool empty() const { return darts_.empty(); }

  /** \brief Calls throw_dart(point) by turn, for points of which is_covered(point) is false at that time. */
  template <typename IsCovered, typename ThrowDart>
  void throw_all(const IsCovered& is_covered, const ThrowDart& throw_dart)
  {
    std::array<std::uint32_t, buckets> end{};
    for (const Dart& dart : darts_) ++end[bucket_of(dart)];
    std::uint32_t sum = 0;
    for (std::uint32_t& e : end) sum += std::exchange(e, sum);
    sorted_.resize(darts_.size());
    for (const Dart& dart : darts_) sorted_[end[bucket_of(dart)]++] = dart;
    auto first = sorted_.begin();
    for (const std::uint32_t e : end) {
      const auto last = sorted_.begin() + e;
      const auto open = std::remove_if(first, last, [&](const Dart& dart) { return is_covered(dart.point); });
      std::sort(first, open);
      for (; first != open; ++first)
        if (!is_covered(first->point)) throw_dart(first->point);
      first = last;
    }
  }

 private:
  static constexpr int bucket_bits = 10;  // the feature rank, and a quarter of the lots
  static constexpr std::size_t buckets = std::size_t{1} << bucket_bits;

  static std::size_t bucket_of(const Dart& dart) { return dart.turn >> (64 - bucket_bits); }

  std::vector<Dart> darts_;
  std::vector<Dart> sorted_;  ///< by bucket
};

/** \brief Throws the darts of one cell after the other. Holds the working memory of one thread. */
class DartThrower
{
 public:
  DartThrower(const OrderedPoints& points,
              const std::vector<std::uint8_t>& feature_rank,
              std::uint64_t seed,
              double spread,
              const CellSchedule& schedule,
              GeodesicDisk& disk,
              PoissonDiskSampling& sampling)
      : points_(points),
        feature_rank_(feature_rank),
        seed_(seed),
        spread_(spread),
        schedule_(schedule),
        disk_(disk),
        radius_(static_cast<float>(sampling.radius)),
        exact_radius_(sampling.radius),
        nearest_(sampling.nearest)
  {
  }

  /** \brief Makes seeds of the given points in a cell, however close to others they are. */
  void place_given(std::size_t cell, const std::vector<std::uint32_t>& given)
  {
    std::vector<std::uint32_t> here;
    std::uint64_t blocks = 0;
    schedule_.visit_points(cell, [&](const RankRange& range, std::uint64_t in_block) {
      for (auto g = std::lower_bound(given.begin(), given.end(), range.begin); g != given.end() && *g < range.end;
           ++g, blocks |= in_block)
        here.push_back(*g);
    });
    if (here.empty()) return;
    enter(cell, blocks);
    for (const std::uint32_t point : here) place_seed(point, grow(point));
    disk_.leave();
  }

  /** \param coverage in radii: points are darts that are farther from all seeds
   * \param least_rank and of this feature rank or a higher one */
  void throw_darts(std::size_t cell, double coverage, std::uint8_t least_rank)
  {
    const float covered = static_cast<float>(coverage) * radius_;
    const auto is_covered = [&](std::uint32_t point) { return nearest_[point].covered(covered); };
    darts_.clear();
    std::uint64_t blocks = 0;
    schedule_.visit_points(cell, [&](const RankRange& range, std::uint64_t in_block) {
      for (std::uint32_t point = range.begin; point < range.end; ++point) {
        if (feature_rank_[point] < least_rank || is_covered(point)) continue;
        darts_.add({turn_of(point), point});
        blocks |= in_block;
      }
    });
    if (darts_.empty()) return;
    enter(cell, blocks);
    darts_.throw_all(is_covered, [this](std::uint32_t point) { throw_dart(point); });
    disk_.leave();
  }

 private:
  using Disk = std::vector<GeodesicDisk::Reached>;

  /** \param blocks of the cell, those that seeds may be in */
  void enter(std::size_t cell, std::uint64_t blocks)
  {
    patch_.clear();
    schedule_.append_surroundings(cell, blocks, patch_);
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

  /** \brief Drawn anew by hashing, wherever it is asked for. */
  [[nodiscard]] float own_radius(std::uint32_t point) const
  {
    if (spread_ == 0) return radius_;
    constexpr std::uint64_t other_lots = 0x5851f42d4c957f2dULL;  // than those of the turns
    const auto lot = static_cast<double>(hash_position(points_.position[point], seed_ ^ other_lots));
    return static_cast<float>(exact_radius_ * (1 + spread_ * std::ldexp(lot, -64)));
  }

  /** \brief A dart becomes a seed, unless its own disk shows that an earlier seed is within its radius after all. */
  void throw_dart(std::uint32_t point)
  {
    const Disk& reached = grow(point);
    GeodesicDisk::Reached nearest_seed{NearestSeeds::none, own_radius(point)};
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
  double spread_;
  const CellSchedule& schedule_;
  GeodesicDisk& disk_;
  float radius_;
  double exact_radius_;
  PointArray<NearestSeeds>& nearest_;
  DartQueue darts_;
  std::vector<RankRange> patch_;
};

/** \brief Lists the seeds, and names them by their place in that list wherever they were named by their point. */
void number_seeds(PoissonDiskSampling& sampling, const Parallel& parallel)
{
  using Seeds = std::vector<std::uint32_t>;
  const PointArray<std::uint32_t> seeds =
      joined(parallel_parts<Seeds>(sampling.nearest.size(), block, parallel,
                                   [&](std::size_t begin, std::size_t end, Seeds& part) {
                                     for (auto i = static_cast<std::uint32_t>(begin); i < end; ++i)
                                       if (sampling.nearest[i].seed[0] == i) part.push_back(i);
                                   }),
             parallel);
  sampling.seeds.assign(seeds.begin(), seeds.end());
  PointArray<std::uint32_t> number_of_point(sampling.nearest.size());  // unset for points that are no seeds
  for (std::uint32_t s = 0; s < seeds.size(); ++s) number_of_point[seeds[s]] = s;
  parallel.each(sampling.nearest.size(), block, [&](std::size_t i) {
    for (std::uint32_t& s : sampling.nearest[i].seed)
      if (s != NearestSeeds::none) s = number_of_point[s];
  });
}

/** \brief One worker's memory, away from the cache lines of others. */
struct alignas(cache_line) Worker
{
  std::optional<GeodesicDisk> disk;
  std::optional<DartThrower> thrower;
};

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
                                         const GivenSeeds& given,
                                         const SteadyCount& steady)
{
  PoissonDiskSampling sampling;
  sampling.radius = radius;
  sampling.nearest.resize(points.size());
  parallel.each(points.size(), block, [&](std::size_t i) { sampling.nearest[i] = NearestSeeds::unknown(); });
  {
    // The working memory of the darts is gone before the seeds are numbered.
    constexpr double rounding_margin = 1.001;  // distances and block borders are rounded to single precision
    const CellSchedule schedule(points, disk_reach * std::max(radius, steady.radius_of_cells) * rounding_margin,
                                parallel);
    PatchMarks marks(points.size());
    std::vector<Worker> workers(parallel.threads());
    const auto each_cell = [&](const auto& action) {
      for (std::size_t color = 0; color < CellSchedule::color_count; ++color) {
        const std::size_t first = schedule.first_cell(color);
        parallel.blocks(schedule.last_cell(color) - first, 1, [&](std::size_t cell, std::size_t, unsigned number) {
          auto& [disk, thrower] = workers[number];
          if (!thrower) {
            disk.emplace(points, graph, surface, weights, solver, marks);
            thrower.emplace(points, feature_rank, seed, steady.spread, schedule, *disk, sampling);
          }
          action(*thrower, first + cell);
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
