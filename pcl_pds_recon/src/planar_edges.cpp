// SPDX-License-Identifier: BSD-3-Clause
#include "planar_edges.h"
#include <Eigen/Geometry>
#include <algorithm>
#include "bucket_sort.h"
#include "parallel_parts.h"

namespace pds
{
namespace
{

using Eigen::Vector3d;

constexpr std::size_t pairs_per_block = 1024;

/** \brief Best evidence first: witnesses, then path, then number. A total order. */
class BetterPair
{
 public:
  explicit BetterPair(const std::vector<SeedPair>& pairs) : pairs_(pairs) {}
  [[nodiscard]] bool operator()(std::uint32_t x, std::uint32_t y) const
  {
    if (pairs_[x].witnesses != pairs_[y].witnesses) return pairs_[x].witnesses > pairs_[y].witnesses;
    if (pairs_[x].path != pairs_[y].path) return pairs_[x].path < pairs_[y].path;
    return x < y;
  }

 private:
  const std::vector<SeedPair>& pairs_;
};

/** \brief The pair crosses a better one, which is reached over an edge that is better, too. */
struct Crossing
{
  std::uint32_t pair, crossed, link;
};

/** \brief Finds what crosses a pair, seen along the mean of its ends' normals. */
class CrossingSearch
{
 public:
  CrossingSearch(const SeedGeometry& seeds, const std::vector<SeedPair>& pairs, const PairGraph& graph)
      : position_(seeds.position), normal_(seeds.normal), pairs_(pairs), graph_(graph), better_(pairs)
  {
  }

  /** \brief Looks at edges next to an end of the pair: others are too far away to cross it in the surface. */
  void find(std::uint32_t pair, std::vector<Crossing>& crossings) const
  {
    const auto [a, b] = std::pair(pairs_[pair].a, pairs_[pair].b);
    const Vector3d along = position_[b] - position_[a];
    Vector3d normal =
        normal_[a].dot(normal_[b]) < 0 ? Vector3d(normal_[a] - normal_[b]) : Vector3d(normal_[a] + normal_[b]);
    normal -= normal.dot(along) / along.squaredNorm() * along;
    // Not "less than": seeds that coincide give no number, and have no such plane either.
    if (!(normal.squaredNorm() >= smallest_normal * smallest_normal)) return;
    const Vector3d left = normal.cross(along);
    for (const std::uint32_t end : {a, b})
      for (const PairGraph::Edge* link = graph_.first(end); link != graph_.last(end); ++link) {
        const std::uint32_t c = link->other;
        if (c == a || c == b || !better_(link->pair, pair)) continue;
        const double c_side = left.dot(position_[c] - position_[a]);
        for (const PairGraph::Edge* edge = graph_.first(c); edge != graph_.last(c); ++edge) {
          const std::uint32_t d = edge->other;
          if (d == a || d == b || !(c_side * left.dot(position_[d] - position_[a]) < 0)) continue;
          if (separates(c, d, a, b, normal) && better_(edge->pair, pair))
            crossings.push_back({pair, edge->pair, link->pair});
        }
      }
  }

 private:
  /** \brief True if a and b lie on different sides of the line through c and d. */
  [[nodiscard]] bool separates(
      std::uint32_t c, std::uint32_t d, std::uint32_t a, std::uint32_t b, const Vector3d& normal) const
  {
    const Vector3d left = normal.cross(position_[d] - position_[c]);
    return left.dot(position_[a] - position_[c]) * left.dot(position_[b] - position_[c]) < 0;
  }

  static constexpr double smallest_normal = 1e-6;  // of unit vectors' sum; below it there is no common plane

  const std::vector<Vector3d>& position_;
  const std::vector<Vector3d>& normal_;
  const std::vector<SeedPair>& pairs_;
  const PairGraph& graph_;
  BetterPair better_;
};

}  // namespace

PairGraph::PairGraph(std::size_t seed_count, const std::vector<SeedPair>& pairs, const Parallel& parallel)
{
  BucketSort by_seed(seed_count);
  parallel.each(pairs.size(), pairs_per_block, [&](std::size_t p) {
    by_seed.count(pairs[p].a);
    by_seed.count(pairs[p].b);
  });
  begin = by_seed.begins();
  edge.resize(begin.back());
  parallel.each(pairs.size(), pairs_per_block, [&](std::size_t p) {
    edge[by_seed.place(pairs[p].a)] = {pairs[p].b, static_cast<std::uint32_t>(p)};
    edge[by_seed.place(pairs[p].b)] = {pairs[p].a, static_cast<std::uint32_t>(p)};
  });
}

std::vector<std::uint8_t> choose_planar_edges(const SeedGeometry& seeds,
                                              const std::vector<SeedPair>& pairs,
                                              const PairGraph& graph,
                                              const Parallel& parallel)
{
  using Crossings = std::vector<Crossing>;
  const CrossingSearch search(seeds, pairs, graph);
  Crossings crossings;
  for (const Crossings& part : parallel_parts<Crossings>(pairs.size(), pairs_per_block, parallel,
                                                         [&](std::size_t begin, std::size_t end, Crossings&found) {
                                                           for (std::size_t p = begin; p < end; ++p)
                                                             search.find(static_cast<std::uint32_t>(p), found);
                                                         }))
    append(crossings, part);

  // A pair's verdict is final when its turn comes, as all it depends on is better.
  std::sort(crossings.begin(), crossings.end(),
            [better = BetterPair(pairs)](const Crossing& x, const Crossing& y) { return better(x.pair, y.pair); });
  std::vector<std::uint8_t> chosen(pairs.size(), 1);
  for (const Crossing& c : crossings)
    if (chosen[c.crossed] != 0 && chosen[c.link] != 0) chosen[c.pair] = 0;
  return chosen;
}

}  // namespace pds
