// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/seed_graph.h>

namespace pds
{

/** \brief Pairs as the edges of a graph: those at a seed follow one another. */
struct PairGraph
{
  struct Edge
  {
    std::uint64_t rank;   ///< the less, the better the evidence: witnesses, then path
    std::uint32_t pair;   ///< decides between equal ranks
    std::uint32_t other;  ///< the seed at the other end

    [[nodiscard]] bool better_than(const Edge& e) const { return rank != e.rank ? rank < e.rank : pair < e.pair; }
  };
  std::vector<std::size_t> begin;  ///< by seed: its first edge; size seeds + 1
  std::vector<Edge> edge;          ///< those at a seed from the best to the worst

  PairGraph(std::size_t seed_count, const std::vector<SeedPair>& pairs, const Parallel& parallel);
  [[nodiscard]] const Edge* first(std::size_t seed) const { return edge.data() + begin[seed]; }
  [[nodiscard]] const Edge* last(std::size_t seed) const { return edge.data() + begin[seed + 1]; }
};

/** \brief Says of every pair whether it is an edge of the planar graph: it is, unless it crosses a better one that is.
 *
 * The same as to insert the pairs one after the other, best evidence first. Crossings are found for all pairs at once;
 * only pairs that have one, one in thirty on a clean surface, are then decided in turn.
 */
[[nodiscard]] std::vector<std::uint8_t> choose_planar_edges(const SeedGeometry& seeds,
                                                            std::size_t pair_count,
                                                            const PairGraph& graph,
                                                            const Parallel& parallel);

}  // namespace pds
