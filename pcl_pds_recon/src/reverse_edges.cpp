// SPDX-License-Identifier: BSD-3-Clause
#include "reverse_edges.h"

#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <limits>
#include <utility>

namespace pds
{
namespace
{

constexpr int fewest_tile_bits = 12;       // of a rank within its tile: some 0.1 ms of work
constexpr int most_tile_number_bits = 11;  // more only where a tile would not fit into one base of the graph's rows

int choose_tile_bits(std::size_t point_count)
{
  int rank_bits = 0;
  while (point_count >> rank_bits > 0) ++rank_bits;
  return std::min(std::max(fewest_tile_bits, rank_bits - most_tile_number_bits), NeighborGraph::base_bits);
}

}  // namespace

ReverseEdges::ReverseEdges(std::size_t point_count, unsigned workers)
    : point_count_(point_count),
      tile_bits_(choose_tile_bits(point_count)),
      tiles_((point_count + tile_size() - 1) >> tile_bits_),
      chunks_of_worker_(workers)
{
}

void ReverseEdges::add(unsigned worker, std::size_t tile, const ReverseEdge* edges, std::size_t count)
{
  Tile& sorted = tiles_[tile];
  sorted.edges = chunks_of_worker_[worker].take(count);
  PackedEdge* const place = sorted.edges;
  std::vector<std::uint32_t>& begin = sorted.begin;
  begin.assign(tile_count() + 1, 0);
  for (std::size_t e = 0; e < count; ++e) ++begin[edges[e].listed >> tile_bits_];
  std::uint32_t sum = 0;
  for (std::uint32_t& b : begin) sum += std::exchange(b, sum);
  for (std::size_t e = 0; e < count; ++e)
    place[begin[edges[e].listed >> tile_bits_]++] = {place_in_tile(edges[e].listed), place_in_tile(edges[e].lister)};
  // Each place has moved on to where the next one began.
  std::rotate(begin.begin(), begin.end() - 1, begin.end());
  begin.front() = 0;
}

/** \brief Visits edges by ascending lister: visit(place of the listed point in its tile, rank of the lister). */
template <typename Visit>
void ReverseEdges::visit_edges_to(std::size_t tile, const Visit& visit) const
{
  for (std::size_t t = 0; t < tiles_.size(); ++t) {
    const Tile& from = tiles_[t];
    if (from.begin.empty()) continue;
    const auto first = static_cast<std::uint32_t>(t << tile_bits_);
    for (std::size_t e = from.begin[tile]; e < from.begin[tile + 1]; ++e)
      visit(from.edges[e].listed, first + from.edges[e].lister);
  }
}

/** \brief By tile, where the rows of its points begin among those of all; last, how many entries there are. */
std::vector<std::size_t> ReverseEdges::row_begin_of_tiles(const Parallel& parallel) const
{
  constexpr std::size_t tiles_per_block = 64;
  std::vector<std::size_t> begin(tile_count() + 1);
  parallel.each(tile_count(), tiles_per_block, [&](std::size_t tile) {
    for (const Tile& from : tiles_)
      if (!from.begin.empty()) begin[tile] += from.begin[tile + 1] - from.begin[tile];
  });
  std::size_t sum = 0;
  for (std::size_t& b : begin) sum += std::exchange(b, sum);
  return begin;
}

void ReverseEdges::file_tile(std::size_t tile, std::size_t row_begin, NeighborGraph& graph) const
{
  const std::size_t first = tile << tile_bits_;
  const std::size_t points = std::min(tile_size(), point_count_ - first);
  std::vector<std::uint32_t> next(points);
  visit_edges_to(tile, [&](std::uint16_t listed, std::uint32_t) { ++next[listed]; });
  auto sum = static_cast<std::uint32_t>(row_begin - graph.reverse_base[first >> NeighborGraph::base_bits]);
  for (std::size_t i = 0; i < points; ++i) {
    graph.reverse_begin[first + i] = sum;
    sum += std::exchange(next[i], sum);
  }
  std::uint32_t* const rows = graph.reverse.data() + graph.reverse_base[first >> NeighborGraph::base_bits];
  visit_edges_to(tile, [&](std::uint16_t listed, std::uint32_t lister) { rows[next[listed]++] = lister; });
}

void ReverseEdges::file(NeighborGraph& graph, const Parallel& parallel) const
{
  const std::vector<std::size_t> row_begin = row_begin_of_tiles(parallel);
  const int tiles_per_base_bits = NeighborGraph::base_bits - tile_bits_;
  for (std::size_t base = 0; base <= point_count_ >> NeighborGraph::base_bits; ++base) {
    const auto begin_of = [&](std::size_t b) { return row_begin[std::min(b << tiles_per_base_bits, tile_count())]; };
    graph.reverse_base.push_back(begin_of(base));
    if (begin_of(base + 1) - begin_of(base) > std::numeric_limits<std::uint32_t>::max())
      throw InvalidInput("the neighbour search gives the same few points as neighbours of all");
  }
  graph.reverse.resize(row_begin.back());
  graph.reverse_begin.resize(point_count_ + 1);
  graph.reverse_begin.back() = static_cast<std::uint32_t>(row_begin.back() - graph.reverse_base.back());
  parallel.each(tile_count(), 1, [&](std::size_t tile) { file_tile(tile, row_begin[tile], graph); });
}

}  // namespace pds
