// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/geodesic_voronoi.h>
#include <algorithm>
#include <array>
#include <numeric>
#include "bucket_sort.h"
#include "seed_evidence.h"

namespace pds
{
namespace
{

constexpr std::size_t cells_per_block = 64;  // cells per block: some thousand points

/** \brief Fills cell_begin and cell_point, the latter in no order within a cell. */
void group_by_cell(const PoissonDiskSampling& sampling, GeodesicVoronoi& voronoi, const Parallel& parallel)
{
  constexpr std::size_t block = 32768;
  const PointArray<NearestSeeds>& nearest = sampling.nearest;
  // Points that follow one another are often of one cell, and counted at once.
  const auto each_run = [&](const auto& action) {
    parallel.blocks(nearest.size(), block, [&](std::size_t begin, std::size_t end, unsigned) {
      for (std::size_t first = begin, last = begin; first < end; first = last) {
        const std::uint32_t seed = nearest[first].seed[0];
        while (last < end && nearest[last].seed[0] == seed) ++last;
        action(seed, first, static_cast<std::uint32_t>(last - first));
      }
    });
  };
  BucketSort by_cell(sampling.seeds.size());
  each_run([&](std::uint32_t seed, std::size_t, std::uint32_t size) { by_cell.count(seed, size); });
  voronoi.cell_begin = by_cell.begins();
  voronoi.cell_point.resize(nearest.size());
  each_run([&](std::uint32_t seed, std::size_t first, std::uint32_t size) {
    const auto place = voronoi.cell_point.begin() + static_cast<std::ptrdiff_t>(by_cell.place(seed, size));
    std::iota(place, place + size, static_cast<std::uint32_t>(first));
  });
}

/** \brief Says which points lie near a Voronoi edge (the paper's criterion). */
class WitnessRule
{
 public:
  WitnessRule(const PoissonDiskSampling& sampling, double threshold)
      : radius_(static_cast<float>(sampling.radius)), limit_(static_cast<float>(threshold * sampling.radius))
  {
  }
  [[nodiscard]] bool operator()(const NearestSeeds& nearest) const
  {
    return nearest.distance[1] <= radius_ && nearest.distance[1] - nearest.distance[0] < limit_;
  }

 private:
  float radius_, limit_;
};

/** \brief Collects what one cell sees of its surroundings. Small linear lists: a cell has about six neighbours. */
class CellSurvey
{
 public:
  CellSurvey(const OrderedPoints& points,
             const NeighborGraph& graph,
             const EdgeWeights& weights,
             const PoissonDiskSampling& sampling,
             const WitnessRule& is_witness)
      : points_(points),
        graph_(graph),
        weights_(weights),
        nearest_(sampling.nearest),
        is_witness_(is_witness),
        corner_limit_(corner_threshold * static_cast<float>(sampling.radius))
  {
  }

  void survey(std::uint32_t seed,
              const std::uint32_t* begin,
              const std::uint32_t* end,
              PointArray<std::uint8_t>& witness)
  {
    seed_ = seed;
    borders_.clear();
    corners_.clear();
    for (const std::uint32_t* point = begin; point != end; ++point) {
      const NearestSeeds& nearest = nearest_[*point];
      witness[*point] = is_witness_(nearest) ? 1 : 0;
      if (witness[*point] != 0) count_witness(nearest);
      // A point about as far from three seeds is near the place where their cells meet.
      if (nearest.distance[2] - nearest.distance[0] < corner_limit_) vote(nearest.seed[1], nearest.seed[2]);
      survey_surroundings(*point, nearest.distance[0]);
    }
  }

  void append_to(std::vector<SeedPair>& pairs, std::vector<SeedTriple>& triples) const
  {
    for (const Border& b : borders_)
      pairs.push_back({std::min(seed_, b.other), std::max(seed_, b.other), b.witnesses, b.path});
    for (const Corner& c : corners_) {
      std::array<std::uint32_t, 3> v{seed_, c.low, c.high};
      std::sort(v.begin(), v.end());
      triples.push_back({v[0], v[1], v[2], c.votes});
    }
  }

 private:
  struct Border
  {
    std::uint32_t other;
    std::uint32_t witnesses;
    float path;
  };
  struct Corner
  {
    std::uint32_t low, high;
    std::uint32_t votes;
  };
  struct Stranger
  {
    std::uint32_t label;  ///< not of the cell that is surveyed
    std::uint32_t point;
  };

  Border& border(std::uint32_t other)
  {
    for (Border& b : borders_)
      if (b.other == other) return b;
    borders_.push_back({other, 0, NearestSeeds::infinity});
    return borders_.back();
  }

  void vote(std::uint32_t s, std::uint32_t t)
  {
    const auto [low, high] = std::minmax(s, t);
    for (Corner& c : corners_)
      if (c.low == low && c.high == high) {
        ++c.votes;
        return;
      }
    corners_.push_back({low, high, 1});
  }

  void count_witness(const NearestSeeds& nearest)
  {
    Border& b = border(nearest.seed[1]);
    ++b.witnesses;
    b.path = std::min(b.path, nearest.distance[0] + nearest.distance[1]);
  }

  /** \brief Looks for points of other cells among those that surround this one: the nearest one of each cell shows a
   * border. Both sides of a border do so. */
  void survey_surroundings(std::uint32_t point, float distance)
  {
    const NeighborSpan row = graph_.nearest(point);
    if (strangers_.size() < row.size()) strangers_.resize(row.size());
    // Whether the next one is a stranger cannot be foretold: written without a branch this takes half the time.
    std::size_t count = 0;
    for (const std::uint32_t neighbor : row) {
      const std::uint32_t label = nearest_[neighbor].seed[0];
      strangers_[count] = {label, neighbor};
      count += label != seed_ ? 1 : 0;
    }
    std::size_t cells = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const Stranger stranger = strangers_[i];
      const auto same_cell = [&](const Stranger& nearer) { return nearer.label == stranger.label; };
      if (std::any_of(strangers_.data(), strangers_.data() + cells, same_cell)) continue;
      strangers_[cells++] = stranger;
      survey_edge(point, distance, stranger);
    }
    if (cells > 1) survey_corner(cells, (at(point) - at(*(row.end() - 1))).squaredNorm());
  }

  void survey_edge(std::uint32_t point, float distance, const Stranger& stranger)
  {
    Border& b = border(stranger.label);
    const float both = distance + nearest_[stranger.point].distance[0];
    if (both >= b.path) return;
    const float weight = 0.5F * (weights_.at(point) + weights_.at(stranger.point));
    b.path = std::min(b.path, both + weight * (at(point) - at(stranger.point)).norm());
  }

  /** \brief Three cells meet where points of two others are as near to each other as neighbours are. */
  void survey_corner(std::size_t cells, float reach2)
  {
    for (std::size_t i = 1; i < cells; ++i)
      for (std::size_t j = 0; j < i; ++j)
        if ((at(strangers_[i].point) - at(strangers_[j].point)).squaredNorm() <= reach2)
          vote(strangers_[i].label, strangers_[j].label);
  }

  [[nodiscard]] const Eigen::Vector3f& at(std::uint32_t point) const { return points_.position[point]; }

  static constexpr float corner_threshold = 0.2F;  // radii; a point this near to a Voronoi vertex votes for it

  const OrderedPoints& points_;
  const NeighborGraph& graph_;
  const EdgeWeights& weights_;
  const PointArray<NearestSeeds>& nearest_;
  const WitnessRule& is_witness_;
  float corner_limit_;
  std::uint32_t seed_ = NearestSeeds::none;
  std::vector<Border> borders_;
  std::vector<Corner> corners_;
  std::vector<Stranger> strangers_;  ///< of one point: the first few of different cells
};

}  // namespace

GeodesicVoronoi build_geodesic_voronoi(const OrderedPoints& points,
                                       const NeighborGraph& graph,
                                       const EdgeWeights& weights,
                                       const PoissonDiskSampling& sampling,
                                       double threshold,
                                       const Parallel& parallel)
{
  GeodesicVoronoi voronoi;
  group_by_cell(sampling, voronoi, parallel);
  voronoi.witness.resize(sampling.nearest.size());

  const WitnessRule is_witness(sampling, threshold);
  std::vector<std::vector<SeedPair>> pairs(parallel.threads());
  std::vector<std::vector<SeedTriple>> triples(parallel.threads());
  parallel.blocks(sampling.seeds.size(), cells_per_block, [&](std::size_t begin, std::size_t end, unsigned worker) {
    CellSurvey cell(points, graph, weights, sampling, is_witness);
    for (std::size_t s = begin; s < end; ++s) {
      std::uint32_t* const first = voronoi.cell_point.data() + voronoi.cell_begin[s];
      std::uint32_t* const last = voronoi.cell_point.data() + voronoi.cell_begin[s + 1];
      if (!std::is_sorted(first, last)) std::sort(first, last);
      cell.survey(static_cast<std::uint32_t>(s), first, last, voronoi.witness);
      cell.append_to(pairs[worker], triples[worker]);
    }
  });

  // Evidence for edges that no two overlapping disks could give leaps a gap in the points.
  const auto limit2 = static_cast<float>(longest_dual_edge * longest_dual_edge * sampling.radius * sampling.radius);
  const auto near = [&](std::uint32_t s, std::uint32_t t) {
    return (points.position[sampling.seeds[s]] - points.position[sampling.seeds[t]]).squaredNorm() <= limit2;
  };
  voronoi.pairs = merge_evidence(
      pairs, sampling.seeds.size(), [&](const SeedPair& p) { return near(p.a, p.b); }, parallel);
  voronoi.triples = merge_evidence(
      triples, sampling.seeds.size(),
      [&](const SeedTriple& t) { return near(t.a, t.b) && near(t.b, t.c) && near(t.a, t.c); }, parallel);
  return voronoi;
}

}  // namespace pds
