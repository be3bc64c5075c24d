// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/nearest_neighbors.h>
#include <pcl_pds_recon/neighbor_graph.h>
#include <pcl_pds_recon/reconstruction.h>
#include <algorithm>

namespace pds
{
namespace
{

constexpr std::size_t block = 8192;  // points per block, a few milliseconds of work

/** \brief Nearest-neighbour rows before symmetrisation; rows may be shorter than their stride. */
struct NeighborRows
{
  std::size_t stride = 0;
  std::vector<std::uint32_t> neighbor;
  std::vector<std::uint16_t> count;

  [[nodiscard]] const std::uint32_t* begin(std::size_t i) const { return neighbor.data() + i * stride; }
  [[nodiscard]] const std::uint32_t* end(std::size_t i) const { return begin(i) + count[i]; }
};

float distance(const OrderedPoints& points, std::size_t a, std::size_t b)
{
  return (points.position[a] - points.position[b]).norm();
}

/** \brief Asks the caller's search for ever more neighbours until k distinct places are known. */
void search_row(const OrderedPoints& points, const PointCloudView& cloud, std::uint32_t rank, NeighborRows& rows)
{
  std::vector<std::uint32_t> found;
  std::vector<std::uint32_t> ranks;
  for (std::size_t count = rows.stride + 1;; count *= 2) {
    found.clear();
    cloud.neighbor_search(points.input_index[rank], count, found);
    ranks.clear();
    for (const std::uint32_t index : found)
      if (index < points.rank_of_input.size() && points.rank_of_input[index] != no_label &&
          points.rank_of_input[index] != rank)
        ranks.push_back(points.rank_of_input[index]);
    std::sort(ranks.begin(), ranks.end());
    ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
    if (ranks.size() >= rows.stride || found.size() < count || count > points.rank_of_input.size()) break;
  }
  std::stable_sort(ranks.begin(), ranks.end(), [&](std::uint32_t a, std::uint32_t b) {
    return distance(points, rank, a) < distance(points, rank, b);
  });
  if (ranks.size() > rows.stride) ranks.resize(rows.stride);
  std::copy(ranks.begin(), ranks.end(), rows.neighbor.begin() + static_cast<std::ptrdiff_t>(rank * rows.stride));
  rows.count[rank] = static_cast<std::uint16_t>(ranks.size());
}

NeighborRows find_neighbors(const OrderedPoints& points,
                            const PointCloudView& cloud,
                            std::size_t k,
                            const Parallel& parallel)
{
  NeighborRows rows;
  rows.stride = k;
  rows.count.assign(points.size(), static_cast<std::uint16_t>(k));
  if (!cloud.neighbor_search) {
    rows.neighbor = nearest_neighbors(points.position, k, parallel);
    return rows;
  }
  rows.neighbor.assign(points.size() * k, 0);
  for (std::uint32_t rank = 0; rank < points.size(); ++rank) search_row(points, cloud, rank, rows);
  return rows;
}

/** \brief True if \a i is one of the own neighbours of \a j. */
bool contains(const NeighborRows& rows, std::size_t j, std::uint32_t i)
{
  return std::find(rows.begin(j), rows.end(j), i) != rows.end(j);
}

/** \brief Mean neighbour distance; per-point means are summed in the order of the points, so that threads don't matter.
 */
double mean_distance(const OrderedPoints& points, const NeighborRows& rows, const Parallel& parallel)
{
  std::vector<double> sum(points.size());
  parallel.each(points.size(), block, [&](std::size_t i) {
    for (const std::uint32_t* j = rows.begin(i); j != rows.end(i); ++j)
      sum[i] += static_cast<double>(distance(points, i, *j));
  });
  double total = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    total += sum[i];
    count += rows.count[i];
  }
  return count > 0 ? total / static_cast<double>(count) : 0.0;
}

}  // namespace

NeighborGraph build_neighbor_graph(const OrderedPoints& points,
                                   const PointCloudView& cloud,
                                   int k,
                                   const Parallel& parallel)
{
  NeighborGraph graph;
  const std::size_t n = points.size();
  graph.row_begin.assign(n + 1, 0);
  if (n < 2) {
    graph.own_count.assign(n, 0);
    return graph;
  }
  const NeighborRows rows =
      find_neighbors(points, cloud, std::min<std::size_t>(static_cast<std::size_t>(k), n - 1), parallel);
  graph.sampling_interval = mean_distance(points, rows, parallel);

  // Bit i * stride + m: neighbour m of point i does not list i itself, so its row gets i in addition.
  std::vector<std::uint8_t> one_sided(rows.neighbor.size());
  parallel.each(n, block, [&](std::size_t i) {
    for (std::size_t m = 0; m < rows.count[i]; ++m)
      one_sided[i * rows.stride + m] = contains(rows, rows.begin(i)[m], static_cast<std::uint32_t>(i)) ? 0 : 1;
  });
  for (std::size_t i = 0; i < n; ++i) {
    graph.row_begin[i + 1] += rows.count[i];
    for (std::size_t m = 0; m < rows.count[i]; ++m)
      if (one_sided[i * rows.stride + m] != 0) ++graph.row_begin[rows.begin(i)[m] + 1];
  }
  for (std::size_t i = 0; i < n; ++i) graph.row_begin[i + 1] += graph.row_begin[i];

  graph.neighbor.resize(graph.row_begin[n]);
  std::vector<std::size_t> next(graph.row_begin.begin(), graph.row_begin.end() - 1);
  for (std::size_t i = 0; i < n; ++i)
    for (const std::uint32_t* j = rows.begin(i); j != rows.end(i); ++j) graph.neighbor[next[i]++] = *j;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t m = 0; m < rows.count[i]; ++m)
      if (one_sided[i * rows.stride + m] != 0) graph.neighbor[next[rows.begin(i)[m]]++] = static_cast<std::uint32_t>(i);
  graph.own_count = rows.count;
  return graph;
}

}  // namespace pds
