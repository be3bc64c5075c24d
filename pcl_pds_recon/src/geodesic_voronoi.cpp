// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/geodesic_voronoi.h>
#include <algorithm>
#include <array>
#include <tuple>

namespace pds
{
namespace
{

constexpr std::size_t cells_per_block = 64;  // cells per block: some thousand points

void group_by_cell(const PoissonDiskSampling& sampling, GeodesicVoronoi& voronoi)
{
  const std::size_t n = sampling.nearest.size();
  voronoi.cell_begin.assign(sampling.seeds.size() + 1, 0);
  for (const NearestSeeds& nearest : sampling.nearest) ++voronoi.cell_begin[nearest.seed[0] + 1];
  for (std::size_t s = 0; s < sampling.seeds.size(); ++s) voronoi.cell_begin[s + 1] += voronoi.cell_begin[s];
  std::vector<std::size_t> next(voronoi.cell_begin.begin(), voronoi.cell_begin.end() - 1);
  voronoi.cell_point.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) voronoi.cell_point[next[sampling.nearest[i].seed[0]]++] = i;
}

/** \brief Collects what one cell sees of its surroundings. Small linear lists: a cell has about six neighbours. */
class CellSurvey
{
 public:
  CellSurvey(const OrderedPoints& points,
             const NeighborGraph& graph,
             const EdgeWeights& weights,
             const PoissonDiskSampling& sampling,
             const std::vector<std::uint8_t>& witness)
      : points_(points), graph_(graph), weights_(weights), sampling_(sampling), witness_(witness)
  {
  }

  void survey(std::uint32_t seed, const std::uint32_t* begin, const std::uint32_t* end)
  {
    pairs.clear();
    triples.clear();
    for (const std::uint32_t* point = begin; point != end; ++point) {
      survey_witness(seed, *point);
      survey_borders(seed, *point);
      survey_corners(seed);
      survey_equidistant(*point);
    }
  }

  std::vector<SeedPair> pairs;
  std::vector<SeedTriple> triples;

 private:
  SeedPair& pair(std::uint32_t s, std::uint32_t t)
  {
    const auto [a, b] = std::minmax(s, t);
    for (SeedPair& p : pairs)
      if (p.a == a && p.b == b) return p;
    pairs.push_back({a, b, 0, NearestSeeds::infinity});
    return pairs.back();
  }

  void vote(std::uint32_t s, std::uint32_t t, std::uint32_t u)
  {
    std::array<std::uint32_t, 3> v{s, t, u};
    std::sort(v.begin(), v.end());
    for (SeedTriple& triple : triples)
      if (triple.a == v[0] && triple.b == v[1] && triple.c == v[2]) {
        ++triple.votes;
        return;
      }
    triples.push_back({v[0], v[1], v[2], 1});
  }

  void survey_witness(std::uint32_t seed, std::uint32_t point)
  {
    const NearestSeeds& nearest = sampling_.nearest[point];
    if (witness_[point] == 0) return;
    SeedPair& p = pair(seed, nearest.seed[1]);
    ++p.witnesses;
    p.path = std::min(p.path, nearest.distance[0] + nearest.distance[1]);
  }

  /** \brief Every graph edge into another cell, seen from both sides. Leaves the other cells' nearest points. */
  void survey_borders(std::uint32_t seed, std::uint32_t point)
  {
    others_.clear();
    for (const std::uint32_t neighbor : graph_.neighbors(point)) {
      const NearestSeeds& nearest = sampling_.nearest[neighbor];
      const std::uint32_t label = nearest.seed[0];
      if (label == seed) continue;
      const float edge = 0.5F * (weights_.at(point) + weights_.at(neighbor)) *
                         (points_.position[point] - points_.position[neighbor]).norm();
      SeedPair& p = pair(seed, label);
      p.path = std::min(p.path, sampling_.nearest[point].distance[0] + edge + nearest.distance[0]);
      others_.push_back({label, neighbor});
    }
  }

  /** \brief Graph triangles with three labels. One walk over each row, looking up who else is a neighbour: rows times
   * rows would be cubic in k. */
  void survey_corners(std::uint32_t seed)
  {
    const auto is_third = [this](const Other& other) { return other.label != others_.front().label; };
    if (std::none_of(others_.begin(), others_.end(), is_third)) return;
    std::sort(others_.begin(), others_.end(), [](const Other& x, const Other& y) { return x.point < y.point; });
    for (const Other& other : others_)
      for (const std::uint32_t next : graph_.neighbors(other.point)) {
        if (next <= other.point) continue;
        const auto place = std::lower_bound(others_.begin(), others_.end(), next,
                                            [](const Other& x, std::uint32_t p) { return x.point < p; });
        if (place != others_.end() && place->point == next && place->label != other.label)
          vote(seed, other.label, place->label);
      }
  }

  /** \brief A point about as far from three seeds is near the place where their cells meet. */
  void survey_equidistant(std::uint32_t point)
  {
    const NearestSeeds& nearest = sampling_.nearest[point];
    if (nearest.distance[2] - nearest.distance[0] < corner_threshold * static_cast<float>(sampling_.radius))
      vote(nearest.seed[0], nearest.seed[1], nearest.seed[2]);
  }

  struct Other
  {
    std::uint32_t label;
    std::uint32_t point;
  };

  static constexpr float corner_threshold = 0.2F;  // radii; a point this near to a Voronoi vertex votes for it

  const OrderedPoints& points_;
  const NeighborGraph& graph_;
  const EdgeWeights& weights_;
  const PoissonDiskSampling& sampling_;
  const std::vector<std::uint8_t>& witness_;
  std::vector<Other> others_;
};

std::vector<std::uint8_t> find_witnesses(const PoissonDiskSampling& sampling,
                                         double threshold,
                                         const Parallel& parallel)
{
  constexpr std::size_t block = 65536;
  const auto radius = static_cast<float>(sampling.radius);
  const auto largest_difference = static_cast<float>(threshold * sampling.radius);
  std::vector<std::uint8_t> witness(sampling.nearest.size());
  parallel.each(witness.size(), block, [&](std::size_t i) {
    const NearestSeeds& nearest = sampling.nearest[i];
    witness[i] =
        nearest.distance[1] <= radius && nearest.distance[1] - nearest.distance[0] < largest_difference ? 1 : 0;
  });
  return witness;
}

/** \brief Both sides of a border report it, in any order of blocks; sorting and adding up leaves one of each. */
void merge_pairs(std::vector<SeedPair>& pairs)
{
  std::sort(pairs.begin(), pairs.end(),
            [](const SeedPair& x, const SeedPair& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
  std::size_t last = 0;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    if (pairs[i].a == pairs[last].a && pairs[i].b == pairs[last].b) {
      pairs[last].witnesses += pairs[i].witnesses;
      pairs[last].path = std::min(pairs[last].path, pairs[i].path);
    } else {
      pairs[++last] = pairs[i];
    }
  }
  if (!pairs.empty()) pairs.resize(last + 1);
}

void merge_triples(std::vector<SeedTriple>& triples)
{
  std::sort(triples.begin(), triples.end(),
            [](const SeedTriple& x, const SeedTriple& y) { return std::tie(x.a, x.b, x.c) < std::tie(y.a, y.b, y.c); });
  std::size_t last = 0;
  for (std::size_t i = 1; i < triples.size(); ++i) {
    if (triples[i].a == triples[last].a && triples[i].b == triples[last].b && triples[i].c == triples[last].c)
      triples[last].votes += triples[i].votes;
    else
      triples[++last] = triples[i];
  }
  if (!triples.empty()) triples.resize(last + 1);
}

/** \brief Drops evidence for edges that no two overlapping disks could give: it leaps a gap in the points. */
void drop_leaps(const OrderedPoints& points, const PoissonDiskSampling& sampling, GeodesicVoronoi& voronoi)
{
  const auto limit = static_cast<float>(longest_dual_edge * sampling.radius);
  const auto leaps = [&](std::uint32_t s, std::uint32_t t) {
    return (points.position[sampling.seeds[s]] - points.position[sampling.seeds[t]]).norm() > limit;
  };
  const auto pair_leaps = [&](const SeedPair& p) { return leaps(p.a, p.b); };
  const auto triple_leaps = [&](const SeedTriple& t) { return leaps(t.a, t.b) || leaps(t.b, t.c) || leaps(t.a, t.c); };
  voronoi.pairs.erase(std::remove_if(voronoi.pairs.begin(), voronoi.pairs.end(), pair_leaps), voronoi.pairs.end());
  voronoi.triples.erase(std::remove_if(voronoi.triples.begin(), voronoi.triples.end(), triple_leaps),
                        voronoi.triples.end());
}

template <typename T>
void append(std::vector<T>& all, const std::vector<T>& more)
{
  all.insert(all.end(), more.begin(), more.end());
}

}  // namespace

GeodesicVoronoi build_geodesic_voronoi(const OrderedPoints& points,
                                       const NeighborGraph& graph,
                                       const EdgeWeights& weights,
                                       const PoissonDiskSampling& sampling,
                                       double threshold,
                                       const Parallel& parallel)
{
  GeodesicVoronoi voronoi;
  group_by_cell(sampling, voronoi);
  voronoi.witness = find_witnesses(sampling, threshold, parallel);

  std::vector<std::vector<SeedPair>> pairs(parallel.threads());
  std::vector<std::vector<SeedTriple>> triples(parallel.threads());
  parallel.blocks(sampling.seeds.size(), cells_per_block, [&](std::size_t begin, std::size_t end, unsigned worker) {
    CellSurvey cell(points, graph, weights, sampling, voronoi.witness);
    for (std::size_t s = begin; s < end; ++s) {
      const std::uint32_t* first = voronoi.cell_point.data();
      cell.survey(static_cast<std::uint32_t>(s), first + voronoi.cell_begin[s], first + voronoi.cell_begin[s + 1]);
      append(pairs[worker], cell.pairs);
      append(triples[worker], cell.triples);
    }
  });
  for (unsigned worker = 0; worker < parallel.threads(); ++worker) {
    append(voronoi.pairs, pairs[worker]);
    append(voronoi.triples, triples[worker]);
  }
  merge_pairs(voronoi.pairs);
  merge_triples(voronoi.triples);
  drop_leaps(points, sampling, voronoi);
  return voronoi;
}

}  // namespace pds
