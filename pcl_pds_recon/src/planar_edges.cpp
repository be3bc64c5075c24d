// SPDX-License-Identifier: BSD-3-Clause
#include "planar_edges.h"
#include <Eigen/Geometry>
#include <algorithm>
#include <cstring>
#include "bucket_sort.h"
#include "parallel_parts.h"

namespace pds
{
namespace
{

using Eigen::Vector3d;

constexpr std::size_t pairs_per_block = 1024;
constexpr std::size_t seeds_per_block = 256;

std::uint64_t rank_of(const SeedPair& p)
{
  std::uint32_t path = 0;  // the bits of floats that are not negative are in the order of the floats
  static_assert(sizeof path == sizeof p.path);
  std::memcpy(&path, &p.path, sizeof path);
  constexpr unsigned path_bits = 32;
  return static_cast<std::uint64_t>(~p.witnesses) << path_bits | path;
}

/** \brief The pair crosses a better one, which is reached over an edge that is better, too. */
struct Crossing
{
  PairGraph::Edge pair;
  std::uint32_t crossed, link;
};

/** \brief Finds what crosses a pair, seen along the mean of its ends' normals. */
class CrossingSearch
{
 public:
  CrossingSearch(const SeedGeometry& seeds, const PairGraph& graph)
      : position_(seeds.position), normal_(seeds.normal), graph_(graph)
  {
  }

  /** \brief Looks at edges next to an end of the pair: others are too far away to cross it in the surface. */
  void find(std::uint32_t a, const PairGraph::Edge& pair, std::vector<Crossing>& crossings) const
  {
    const std::uint32_t b = pair.other;
    const Vector3d along = position_[b] - position_[a];
    Vector3d normal =
        normal_[a].dot(normal_[b]) < 0 ? Vector3d(normal_[a] - normal_[b]) : Vector3d(normal_[a] + normal_[b]);
    normal -= normal.dot(along) / along.squaredNorm() * along;
    // Not "less than": seeds that coincide give no number, and have no such plane either.
    if (!(normal.squaredNorm() >= smallest_normal * smallest_normal)) return;
    const Vector3d left = normal.cross(along);
    // Better edges stand before the pair itself in the rows of its ends.
    for (const std::uint32_t end : {a, b})
      for (const PairGraph::Edge* link = graph_.first(end); link->better_than(pair); ++link) {
        const std::uint32_t c = link->other;
        if (c == a || c == b) continue;
        const double c_side = left.dot(position_[c] - position_[a]);
        for (const PairGraph::Edge* edge = graph_.first(c); edge != graph_.last(c) && edge->better_than(pair); ++edge) {
          const std::uint32_t d = edge->other;
          if (!(c_side * left.dot(position_[d] - position_[a]) < 0) || d == a || d == b) continue;
          if (separates(c, d, a, b, normal)) crossings.push_back({pair, edge->pair, link->pair});
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
  const PairGraph& graph_;
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
    const std::uint64_t rank = rank_of(pairs[p]);
    edge[by_seed.place(pairs[p].a)] = {rank, static_cast<std::uint32_t>(p), pairs[p].b};
    edge[by_seed.place(pairs[p].b)] = {rank, static_cast<std::uint32_t>(p), pairs[p].a};
  });
  parallel.each(seed_count, seeds_per_block, [&](std::size_t s) {
    std::sort(edge.begin() + static_cast<std::ptrdiff_t>(begin[s]),
              edge.begin() + static_cast<std::ptrdiff_t>(begin[s + 1]),
              [](const Edge& x, const Edge& y) { return x.better_than(y); });
  });
}

std::vector<std::uint8_t> choose_planar_edges(const SeedGeometry& seeds,
                                              std::size_t pair_count,
                                              const PairGraph& graph,
                                              const Parallel& parallel)
{
  using Crossings = std::vector<Crossing>;
  const CrossingSearch search(seeds, graph);
  Crossings crossings;
  for (const Crossings& part : parallel_parts<Crossings>(
           seeds.position.size(), seeds_per_block, parallel, [&](std::size_t begin, std::size_t end, Crossings&found) {
             for (std::size_t a = begin; a < end; ++a)
               for (const PairGraph::Edge* e = graph.first(a); e != graph.last(a); ++e)
                 if (a < e->other) search.find(static_cast<std::uint32_t>(a), *e, found);
           }))
    append(crossings, part);

  // A pair's verdict is final when its turn comes, as all it depends on is better.
  std::sort(crossings.begin(), crossings.end(),
            [](const Crossing& x, const Crossing& y) { return x.pair.better_than(y.pair); });
  std::vector<std::uint8_t> chosen(pair_count, 1);
  for (const Crossing& c : crossings)
    if (chosen[c.crossed] != 0 && chosen[c.link] != 0) chosen[c.pair.pair] = 0;
  return chosen;
}

}  // namespace pds
