// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/nearest_neighbors.h>
#include <pcl_pds_recon/neighbor_graph.h>
#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "radix_sort.h"

namespace pds
{
namespace
{

constexpr std::size_t block = 4096;  // points per block: some 0.2 ms

float squared_distance(const OrderedPoints& points, std::size_t a, std::size_t b)
{
  const Eigen::Vector3f d = points.position[a] - points.position[b];
  return d.x() * d.x() + d.y() * d.y() + d.z() * d.z();  // added up in the order of the search, with its rounding
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
    return squared_distance(points, rank, a) < squared_distance(points, rank, b);
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
  if (!cloud.neighbor_search) {
    graph.own = nearest_neighbors(points.position, graph.stride, parallel);
    return;
  }
  graph.own.assign(points.size() * graph.stride, 0);
  graph.own_count.assign(points.size(), 0);
  for (std::uint32_t rank = 0; rank < points.size(); ++rank) search_row(points, cloud, rank, graph);
}

/** \brief What one end of an edge lists and the other does not. */
struct ReverseEdge
{
  std::uint32_t listed;
  std::uint32_t lister;
};

/** \brief Tells whether a point lists another, for rows that hold all of the nearest: those not beyond the last one. */
class CompleteRows
{
 public:
  CompleteRows(const OrderedPoints& points, const NeighborGraph& graph, const Parallel& parallel)
      : last_(make_raw_array<std::uint64_t>(points.size()))
  {
    parallel.each(points.size(), block, [&](std::size_t i) {
      const std::uint32_t last = graph.own[(i + 1) * graph.stride - 1];
      last_[i] = place(squared_distance(points, i, last), last);
    });
  }

  [[nodiscard]] bool lists(std::uint32_t lister, std::uint32_t listed, float squared_distance) const
  {
    return place(squared_distance, listed) <= last_[lister];
  }

 private:
  /** \brief Squared distance and rank in one integer that sorts like the pair. */
  static std::uint64_t place(float squared_distance, std::uint32_t rank)
  {
    std::uint32_t bits;
    std::memcpy(&bits, &squared_distance, sizeof bits);
    return std::uint64_t{bits} << 32 | rank;
  }

  RawArray<std::uint64_t> last_;
};

/** \brief The same for rows of a caller's search, which may have overlooked some. */
class AnyRows
{
 public:
  explicit AnyRows(const NeighborGraph& graph) : graph_(graph) {}

  [[nodiscard]] bool lists(std::uint32_t lister, std::uint32_t listed, float /*squared_distance*/) const
  {
    const NeighborSpan row = graph_.nearest(lister);
    return std::find(row.begin(), row.end(), listed) != row.end();
  }

 private:
  const NeighborGraph& graph_;
};

/** \brief What one walk over the rows of some points finds. */
struct RowSurvey
{
  double length = 0;  ///< sum of the distances of all neighbours
  std::size_t length_count = 0;
  std::vector<ReverseEdge> edges;  ///< by ascending lister

  RowSurvey& operator+=(const RowSurvey& other)
  {
    length += other.length;
    length_count += other.length_count;
    return *this;
  }
};

template <typename Rows>
RowSurvey survey_rows(
    const OrderedPoints& points, const NeighborGraph& graph, const Rows& rows, std::size_t begin, std::size_t end)
{
  RowSurvey survey;
  std::size_t edge_count = 0;
  for (std::size_t i = begin; i < end; ++i) {
    const auto own = static_cast<std::uint32_t>(i);
    // Without branches: every edge is written, and stays if the next place is beyond it.
    if (survey.edges.size() < edge_count + graph.stride) survey.edges.resize(2 * edge_count + graph.stride);
    for (const std::uint32_t j : graph.nearest(i)) {
      const float squared = squared_distance(points, i, j);
      survey.length += static_cast<double>(std::sqrt(squared));
      survey.edges[edge_count] = {j, own};
      edge_count += rows.lists(j, own, squared) ? 0U : 1U;
    }
    survey.length_count += graph.nearest(i).size();
  }
  survey.edges.resize(edge_count);
  return survey;
}

/** \brief Files edges, which are sorted by the point that is listed, as rows of the graph. */
void file_rows(const ReverseEdge* edges,
               std::size_t edge_count,
               std::size_t point_count,
               NeighborGraph& graph,
               const Parallel& parallel)
{
  constexpr std::size_t base_points = std::size_t{1} << NeighborGraph::base_bits;
  for (std::size_t first = 0; first < point_count + base_points; first += base_points) {
    const ReverseEdge* row =
        std::partition_point(edges, edges + edge_count, [first](const ReverseEdge& e) { return e.listed < first; });
    graph.reverse_base.push_back(static_cast<std::size_t>(row - edges));
    if (first > 0 &&
        graph.reverse_base.back() - graph.reverse_base.end()[-2] > std::numeric_limits<std::uint32_t>::max())
      throw InvalidInput("the neighbour search gives the same few points as neighbours of all");
  }
  graph.reverse.resize(edge_count);
  graph.reverse_begin.resize(point_count + 1);
  // Edge e begins the rows of all points after the one before it that is listed, up to its own.
  parallel.each(edge_count + 1, block, [&](std::size_t e) {
    const std::size_t first = e > 0 ? std::size_t{edges[e - 1].listed} + 1 : 0;
    const std::size_t last = e < edge_count ? edges[e].listed : point_count;
    for (std::size_t i = first; i <= last; ++i)
      graph.reverse_begin[i] = static_cast<std::uint32_t>(e - graph.reverse_base[i >> NeighborGraph::base_bits]);
    if (e < edge_count) graph.reverse[e] = edges[e].lister;
  });
}

/** \brief Measures the sampling interval, and files edges that only one end lists with the other end as well. */
template <typename Rows>
void join_rows(const OrderedPoints& points, const Rows& rows, NeighborGraph& graph, const Parallel& parallel)
{
  const std::size_t n = points.size();
  std::vector<RowSurvey> surveys((n + block - 1) / block);
  parallel.blocks(n, block, [&](std::size_t begin, std::size_t end, unsigned) {
    surveys[begin / block] = survey_rows(points, graph, rows, begin, end);
  });
  RowSurvey total;
  std::vector<std::size_t> first_edge{0};
  for (const RowSurvey& survey : surveys) {
    total += survey;
    first_edge.push_back(first_edge.back() + survey.edges.size());
  }
  if (total.length_count > 0) graph.sampling_interval = total.length / static_cast<double>(total.length_count);

  const auto edges = make_raw_array<ReverseEdge>(first_edge.back());
  const auto other = make_raw_array<ReverseEdge>(first_edge.back());
  parallel.each(surveys.size(), 1, [&](std::size_t b) {
    std::copy(surveys[b].edges.begin(), surveys[b].edges.end(), edges.get() + first_edge[b]);
    surveys[b].edges = {};
  });
  int rank_bits = 1;
  while (n >> rank_bits > 0) ++rank_bits;
  const ReverseEdge* sorted = radix_sort(
      edges.get(), other.get(), first_edge.back(), {0, rank_bits}, [](const ReverseEdge& e) { return e.listed; },
      parallel);
  file_rows(sorted, first_edge.back(), n, graph, parallel);
}

}  // namespace

NeighborGraph build_neighbor_graph(const OrderedPoints& points,
                                   const PointCloudView& cloud,
                                   int k,
                                   const Parallel& parallel)
{
  NeighborGraph graph;
  if (points.size() < 2) {
    file_rows(nullptr, 0, points.size(), graph, parallel);
    return graph;
  }
  graph.stride = std::min<std::size_t>(static_cast<std::size_t>(k), points.size() - 1);
  find_own_neighbors(points, cloud, graph, parallel);
  if (cloud.neighbor_search)
    join_rows(points, AnyRows(graph), graph, parallel);
  else
    join_rows(points, CompleteRows(points, graph, parallel), graph, parallel);
  return graph;
}

}  // namespace pds
