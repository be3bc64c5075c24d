// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/nearest_neighbors.h>
#include <pcl_pds_recon/neighbor_graph.h>
#include <algorithm>

namespace pds
{
namespace
{

constexpr std::size_t block = 8192;  // points per block, a few milliseconds of work

float distance(const OrderedPoints& points, std::size_t a, std::size_t b)
{
  return (points.position[a] - points.position[b]).norm();
}

/** \brief Asks the caller's search for ever more neighbours until k distinct places are known. */
void search_row(const OrderedPoints& points, const PointCloudView& cloud, std::uint32_t rank, NeighborGraph& graph)
{
  std::vector<std::uint32_t> found;
  std::vector<std::uint32_t> ranks;
  for (std::size_t count = graph.stride + 1;; count *= 2) {
    found.clear();
    cloud.neighbor_search(points.input_index[rank], count, found);
    ranks.clear();
    for (const std::uint32_t index : found)
      if (index < points.rank_of_input.size() && points.rank_of_input[index] != no_rank &&
          points.rank_of_input[index] != rank)
        ranks.push_back(points.rank_of_input[index]);
    std::sort(ranks.begin(), ranks.end());
    ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
    if (ranks.size() >= graph.stride || found.size() < count || count > points.rank_of_input.size()) break;
  }
  std::stable_sort(ranks.begin(), ranks.end(), [&](std::uint32_t a, std::uint32_t b) {
    return distance(points, rank, a) < distance(points, rank, b);
  });
  if (ranks.size() > graph.stride) ranks.resize(graph.stride);
  std::copy(ranks.begin(), ranks.end(), graph.own.begin() + static_cast<std::ptrdiff_t>(rank * graph.stride));
  graph.own_count[rank] = static_cast<std::uint16_t>(ranks.size());
}

void find_own_neighbors(const OrderedPoints& points,
                        const PointCloudView& cloud,
                        NeighborGraph& graph,
                        const Parallel& parallel)
{
  graph.own_count.assign(points.size(), static_cast<std::uint16_t>(graph.stride));
  if (!cloud.neighbor_search) {
    graph.own = nearest_neighbors(points.position, graph.stride, parallel);
    return;
  }
  graph.own.assign(points.size() * graph.stride, 0);
  for (std::uint32_t rank = 0; rank < points.size(); ++rank) search_row(points, cloud, rank, graph);
}

/** \brief True if \a i is one of the own neighbours of \a j. Counts without leaving early: that is vector code. */
bool lists(const NeighborGraph& graph, std::size_t j, std::uint32_t i)
{
  unsigned found = 0;
  for (const std::uint32_t neighbor : graph.nearest(j)) found += neighbor == i ? 1U : 0U;
  return found != 0;
}

/** \brief Mean neighbour distance; per-point sums are added in the order of the points, so that threads don't matter.
 */
double mean_distance(const OrderedPoints& points, const NeighborGraph& graph, const Parallel& parallel)
{
  std::vector<float> sum(points.size());
  parallel.each(points.size(), block, [&](std::size_t i) {
    for (const std::uint32_t j : graph.nearest(i)) sum[i] += distance(points, i, j);
  });
  double total = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    total += static_cast<double>(sum[i]);
    count += graph.own_count[i];
  }
  return count > 0 ? total / static_cast<double>(count) : 0.0;
}

/** \brief Finds the edges that only one end lists and files them with the other end.
 *
 * Each block of points collects its edges by itself; taken in the order of the blocks they ascend by rank.
 */
void add_reverse_edges(NeighborGraph& graph, const Parallel& parallel)
{
  struct Edge
  {
    std::uint32_t listed, lister;
  };
  const std::size_t n = graph.size();
  std::vector<std::vector<Edge>> one_sided((n + block - 1) / block);
  parallel.blocks(n, block, [&](std::size_t begin, std::size_t end, unsigned) {
    std::vector<Edge>& edges = one_sided[begin / block];
    for (std::size_t i = begin; i < end; ++i)
      for (const std::uint32_t j : graph.nearest(i))
        if (!lists(graph, j, static_cast<std::uint32_t>(i))) edges.push_back({j, static_cast<std::uint32_t>(i)});
  });
  graph.reverse_begin.assign(n + 1, 0);
  for (const auto& edges : one_sided)
    for (const Edge& e : edges) ++graph.reverse_begin[e.listed + 1];
  for (std::size_t i = 0; i < n; ++i) graph.reverse_begin[i + 1] += graph.reverse_begin[i];
  graph.reverse.resize(graph.reverse_begin[n]);
  std::vector<std::size_t> next(graph.reverse_begin.begin(), graph.reverse_begin.end() - 1);
  for (const auto& edges : one_sided)
    for (const Edge& e : edges) graph.reverse[next[e.listed]++] = e.lister;
}

}  // namespace

NeighborGraph build_neighbor_graph(const OrderedPoints& points,
                                   const PointCloudView& cloud,
                                   int k,
                                   const Parallel& parallel)
{
  NeighborGraph graph;
  if (points.size() > 1) {
    graph.stride = std::min<std::size_t>(static_cast<std::size_t>(k), points.size() - 1);
    find_own_neighbors(points, cloud, graph, parallel);
    graph.sampling_interval = mean_distance(points, graph, parallel);
  } else {
    graph.own_count.assign(points.size(), 0);
  }
  add_reverse_edges(graph, parallel);
  return graph;
}

}  // namespace pds
