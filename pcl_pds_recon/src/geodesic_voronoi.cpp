// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/geodesic_voronoi.h>
#include <algorithm>
#include <array>
#include <numeric>
#include <optional>
#include <utility>
#include "bucket_sort.h"
#include "local_sparsity.h"
#include "parallel_parts.h"
#include "seed_evidence.h"

namespace pds
{
namespace
{

constexpr std::size_t cells_per_block = 64;  // cells per block: some thousand points

/** \brief By point: the seed whose cell it is in. What surrounds a point is looked up here, in a sixth of the memory.
 */
using Labels = PointArray<std::uint32_t>;

/** \brief Fills cell_begin and cell_point, the latter in no order within a cell. */
Labels group_by_cell(const PoissonDiskSampling& sampling, GeodesicVoronoi& voronoi, const Parallel& parallel)
{
  constexpr std::size_t block = 32768;
  const std::size_t points = sampling.nearest.size();
  Labels label(points);
  parallel.each(points, block, [&](std::size_t i) { label[i] = sampling.nearest[i].seed[0]; });
  // Points that follow one another are often of one cell, and counted at once.
  const auto each_run = [&](const auto& action) {
    parallel.blocks(points, block, [&](std::size_t begin, std::size_t end, unsigned) {
      for (std::size_t first = begin, last = begin; first < end; first = last) {
        const std::uint32_t seed = label[first];
        while (last < end && label[last] == seed) ++last;
        action(seed, first, static_cast<std::uint32_t>(last - first));
      }
    });
  };
  BucketSort by_cell(sampling.seeds.size());
  each_run([&](std::uint32_t seed, std::size_t, std::uint32_t size) { by_cell.count(seed, size); });
  voronoi.cell_begin = by_cell.begins();
  voronoi.cell_point.resize(points);
  each_run([&](std::uint32_t seed, std::size_t first, std::uint32_t size) {
    const auto place = voronoi.cell_point.begin() + static_cast<std::ptrdiff_t>(by_cell.place(seed, size));
    std::iota(place, place + size, static_cast<std::uint32_t>(first));
  });
  return label;
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

/** \brief Collects what one cell after the other sees of its surroundings.
 *
 * The cells beside one, about six, have small numbers, their slots: nothing is searched for, and little is left to
 * branches that cannot be foretold.
 */
class CellSurvey
{
 public:
  CellSurvey(const OrderedPoints& points,
             const NeighborGraph& graph,
             const EdgeWeights& weights,
             const PoissonDiskSampling& sampling,
             const Labels& label,
             const WitnessRule& is_witness)
      : points_(points),
        graph_(graph),
        weights_(weights),
        nearest_(sampling.nearest.data()),
        label_(label.data()),
        is_witness_(is_witness),
        corner_limit_(corner_threshold * static_cast<float>(sampling.radius)),
        slot_of_(sampling.seeds.size(), no_slot),
        strangers_(graph.stride),
        meetings_(graph.stride)
  {
  }

  void survey(std::uint32_t seed, const std::uint32_t* begin, const std::uint32_t* end, std::uint8_t* witness)
  {
    for (const Border& b : borders_) slot_of_[b.other] = no_slot;
    borders_.clear();
    votes_.clear();
    seed_ = seed;
    for (const std::uint32_t* point = begin; point != end; ++point) {
      const NearestSeeds& nearest = nearest_[*point];
      witness[*point] = is_witness_(nearest) ? 1 : 0;
      if (witness[*point] != 0) count_witness(nearest);
      // A point about as far from three seeds is near the place where their cells meet.
      if (nearest.distance[2] - nearest.distance[0] < corner_limit_)
        ++votes(slot_of(nearest.seed[1]), slot_of(nearest.seed[2]));
      survey_surroundings(*point, nearest.distance[0]);
    }
  }

  void append_to(PointArray<SeedPair>& pairs, PointArray<SeedTriple>& triples)
  {
    for (std::uint32_t high = 0; high < borders_.size(); ++high) {
      const Border& b = borders_[high];
      if (b.path < NearestSeeds::infinity)
        pairs.push_back({std::min(seed_, b.other), std::max(seed_, b.other), b.witnesses, b.path});
      for (std::uint32_t low = 0; low < high; ++low) {
        if (votes(low, high) == 0) continue;
        std::array<std::uint32_t, 3> v{seed_, borders_[low].other, b.other};
        std::sort(v.begin(), v.end());
        triples.push_back({v[0], v[1], v[2], votes(low, high)});
      }
    }
  }

 private:
  struct Border
  {
    std::uint32_t other;
    std::uint32_t witnesses;
    float path;                ///< infinite: no border, only a corner that a point is near to
    std::uint32_t last_point;  ///< the last one that saw the other cell
  };
  /** \brief A point of another cell, the nearest of that cell to the point in question. */
  struct Meeting
  {
    std::uint32_t slot, point;
  };

  std::uint32_t slot_of(std::uint32_t seed)
  {
    std::uint32_t& slot = slot_of_[seed];
    if (slot == no_slot) {
      slot = static_cast<std::uint32_t>(borders_.size());
      borders_.push_back({seed, 0, NearestSeeds::infinity, no_rank});
      votes_.resize(votes_.size() + slot);
    }
    return slot;
  }

  /** \brief For the corner between this cell and those in two slots. */
  std::uint32_t& votes(std::uint32_t s, std::uint32_t t)
  {
    const std::size_t high = std::max(s, t);
    return votes_[high * (high - 1) / 2 + std::min(s, t)];
  }

  void count_witness(const NearestSeeds& nearest)
  {
    Border& b = borders_[slot_of(nearest.seed[1])];
    ++b.witnesses;
    b.path = std::min(b.path, nearest.distance[0] + nearest.distance[1]);
  }

  /** \brief Looks for points of other cells among those that surround this one: the nearest one of each cell shows a
   * border. Both sides of a border do so. */
  void survey_surroundings(std::uint32_t point, float distance)
  {
    const NeighborSpan row = graph_.nearest(point);
    // Whether the next one is a stranger cannot be foretold: written without a branch this takes half the time.
    const std::uint32_t seed = seed_;  // a copy, which what is written below cannot change
    std::size_t strangers = 0;
    for (const std::uint32_t neighbor : row) {
      strangers_[strangers] = neighbor;
      strangers += label_[neighbor] != seed ? 1 : 0;
    }
    std::size_t cells = 0;
    for (std::size_t i = 0; i < strangers; ++i) {
      const std::uint32_t slot = slot_of(label_[strangers_[i]]);
      meetings_[cells] = {slot, strangers_[i]};
      cells += borders_[slot].last_point != point ? 1 : 0;
      borders_[slot].last_point = point;
    }
    for (std::size_t i = 0; i < cells; ++i) survey_edge(point, distance, meetings_[i]);
    if (cells > 1) survey_corner(cells, (at(point) - at(*(row.end() - 1))).squaredNorm());
  }

  void survey_edge(std::uint32_t point, float distance, const Meeting& stranger)
  {
    Border& b = borders_[stranger.slot];
    const float both = distance + nearest_[stranger.point].distance[0];
    if (both >= b.path) return;
    const float weight = 0.5F * (weights_.at(point) + weights_.at(stranger.point));
    b.path = std::min(b.path, both + weight * (at(point) - at(stranger.point)).norm());
  }

  /** \brief Three cells meet where points of two others are as near to each other as neighbours are. */
  void survey_corner(std::size_t cells, float reach2)
  {
    for (std::size_t i = 1; i < cells; ++i)
      for (std::size_t j = 0; j < i; ++j) {
        const float distance2 = (at(meetings_[i].point) - at(meetings_[j].point)).squaredNorm();
        votes(meetings_[i].slot, meetings_[j].slot) += distance2 <= reach2 ? 1 : 0;
      }
  }

  [[nodiscard]] const Eigen::Vector3f& at(std::uint32_t point) const { return points_.position[point]; }

  static constexpr float corner_threshold = 0.2F;  // radii; a point this near to a Voronoi vertex votes for it
  static constexpr std::uint32_t no_slot = 0xffffffffU;

  const OrderedPoints& points_;
  const NeighborGraph& graph_;
  const EdgeWeights& weights_;
  const NearestSeeds* nearest_;
  const std::uint32_t* label_;
  const WitnessRule& is_witness_;
  float corner_limit_;
  std::uint32_t seed_ = NearestSeeds::none;
  std::vector<std::uint32_t> slot_of_;    ///< by seed
  std::vector<Border> borders_;           ///< by slot
  std::vector<std::uint32_t> votes_;      ///< by two slots, the higher one first
  std::vector<std::uint32_t> strangers_;  ///< of one point: its neighbours in other cells
  std::vector<Meeting> meetings_;         ///< of one point
};

/** \brief One worker's cell and what it has seen so far, away from the cache lines of other workers. */
struct alignas(cache_line) Surveyor
{
  std::optional<CellSurvey> cell;
  PointArray<SeedPair> pairs;
  PointArray<SeedTriple> triples;
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
  const Labels label = group_by_cell(sampling, voronoi, parallel);
  voronoi.witness.resize(sampling.nearest.size());

  const WitnessRule is_witness(sampling, threshold);
  std::vector<Surveyor> surveyors(parallel.threads());
  for (Surveyor& surveyor : surveyors) {
    // Growing would take the memory twice; what is not used takes none.
    constexpr std::size_t per_cell = 16;  // neighbours, and corners; six to ten are usual
    surveyor.pairs.reserve(per_cell * sampling.seeds.size() / surveyors.size());
    surveyor.triples.reserve(per_cell * sampling.seeds.size() / surveyors.size());
  }
  parallel.blocks(sampling.seeds.size(), cells_per_block, [&](std::size_t begin, std::size_t end, unsigned worker) {
    Surveyor& surveyor = surveyors[worker];
    if (!surveyor.cell) surveyor.cell.emplace(points, graph, weights, sampling, label, is_witness);
    for (std::size_t s = begin; s < end; ++s) {
      std::uint32_t* const first = voronoi.cell_point.data() + voronoi.cell_begin[s];
      std::uint32_t* const last = voronoi.cell_point.data() + voronoi.cell_begin[s + 1];
      if (!std::is_sorted(first, last)) std::sort(first, last);
      surveyor.cell->survey(static_cast<std::uint32_t>(s), first, last, voronoi.witness.data());
      surveyor.cell->append_to(surveyor.pairs, surveyor.triples);
    }
  });
  std::vector<PointArray<SeedPair>> pairs;
  std::vector<PointArray<SeedTriple>> triples;
  for (Surveyor& surveyor : surveyors) {
    pairs.push_back(std::move(surveyor.pairs));
    triples.push_back(std::move(surveyor.triples));
  }
  surveyors.clear();

  // Evidence for edges that no two overlapping disks could give leaps a gap in the points.
  voronoi.sparsity = local_sparsity(points, graph, sampling, voronoi.cell_begin, parallel);
  const auto limit = static_cast<float>(longest_dual_edge * sampling.radius);
  const auto near = [&](std::uint32_t s, std::uint32_t t) {
    const float longest = limit * std::max(voronoi.sparsity[s], voronoi.sparsity[t]);
    return (points.position[sampling.seeds[s]] - points.position[sampling.seeds[t]]).squaredNorm() <= longest * longest;
  };
  voronoi.pairs = merge_evidence(
      std::move(pairs), sampling.seeds.size(), [&](const SeedPair& p) { return near(p.a, p.b); }, parallel);
  voronoi.triples = merge_evidence(
      std::move(triples), sampling.seeds.size(),
      [&](const SeedTriple& t) { return near(t.a, t.b) && near(t.b, t.c) && near(t.a, t.c); }, parallel);
  return voronoi;
}

}  // namespace pds
