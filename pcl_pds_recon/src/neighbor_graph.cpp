// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/nearest_neighbors.h>
#include <pcl_pds_recon/neighbor_graph.h>
#include <pcl_pds_recon/options.h>

#include <algorithm>
#include <cmath>

#include "reverse_edges.h"

namespace pds
{
namespace
{

constexpr std::size_t block = 4096;  // points per block: some 0.2 ms

/** \brief Added up in the order of the search, with its rounding. */
float squared_distance(const Eigen::Vector3f& a, const Eigen::Vector3f& b)
{
  const Eigen::Vector3f d = a - b;
  return d.x() * d.x() + d.y() * d.y() + d.z() * d.z();
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
    return squared_distance(points.position[rank], points.position[a]) <
           squared_distance(points.position[rank], points.position[b]);
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

PointArray<Reach> measure_reach(const OrderedPoints& points, const NeighborGraph& graph, const Parallel& parallel)
{
  PointArray<Reach> reach(points.size());
  parallel.each(points.size(), block, [&](std::size_t i) {
    const NeighborSpan row = graph.nearest(i);
    const std::uint32_t last = row.size() > 0 ? *(row.end() - 1) : static_cast<std::uint32_t>(i);
    reach[i] = {squared_distance(points.position[i], points.position[last]), last};
  });
  return reach;
}

/** \brief Tells whether a point lists another, for rows that hold all of the nearest: those not beyond the last one. */
class CompleteRows
{
 public:
  explicit CompleteRows(const NeighborGraph& graph) : reach_(graph.reach.data()) {}

  [[nodiscard]] bool lists(std::uint32_t lister, std::uint32_t listed, float squared_distance) const
  {
    // Without branches, for the last one is often the one in question.
    const Reach reach = reach_[lister];
    const bool nearer = squared_distance < reach.squared;
    const bool as_near = (squared_distance == reach.squared) & (listed <= reach.rank);
    return nearer | as_near;
  }

 private:
  const Reach* reach_;
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

/** \brief The same if some rows lack points of another sheet, and hold farther ones of their own. */
class PartedRows
{
 public:
  explicit PartedRows(const NeighborGraph& graph) : reach_(graph.reach.data()), complete_(graph), any_(graph) {}

  [[nodiscard]] bool lists(std::uint32_t lister, std::uint32_t listed, float squared_distance) const
  {
    return reach_[lister].rank == Reach::parted ? any_.lists(lister, listed, squared_distance)
                                                : complete_.lists(lister, listed, squared_distance);
  }

 private:
  const Reach* reach_;
  CompleteRows complete_;
  AnyRows any_;
};

/** \brief What a walk over rows finds out about their lengths. */
class Lengths
{
 public:
  static constexpr std::size_t lanes = 4;  // roots that are taken together: floats in the narrowest vector register

  /** \param squares of the distances to a point's neighbours, with zeros behind the last one, up to the next multiple
   * of \a lanes \param outreached how many of the neighbours reach far less than the point */
  void add(const float* squares, std::size_t count, std::size_t outreached, bool stray)
  {
    lone_points_ += outreached > count / 2 ? 1 : 0;
    (stray ? of_strays_ : of_others_).add(squares, count);
  }
  Lengths& operator+=(const Lengths& other)
  {
    of_others_ += other.of_others_;
    of_strays_ += other.of_strays_;
    lone_points_ += other.lone_points_;
    return *this;
  }
  /** \brief Without strays, unless these are so many that they may be a coarser surface. */
  [[nodiscard]] double mean() const
  {
    constexpr std::size_t fewest_others = 9;  // times as many
    Sum sum = of_others_;
    if (of_others_.count < fewest_others * of_strays_.count) sum += of_strays_;
    return sum.mean();
  }
  [[nodiscard]] std::size_t lone_points() const { return lone_points_; }

 private:
  struct Sum
  {
    double lane[lanes] = {};
    std::size_t count = 0;

    void add(const float* squares, std::size_t more)
    {
      for (std::size_t j = 0; j < more; j += lanes)
        for (std::size_t l = 0; l < lanes; ++l) lane[l] += static_cast<double>(std::sqrt(squares[j + l]));
      count += more;
    }
    Sum& operator+=(const Sum& other)
    {
      for (std::size_t l = 0; l < lanes; ++l) lane[l] += other.lane[l];
      count += other.count;
      return *this;
    }
    [[nodiscard]] double mean() const
    {
      return count > 0 ? ((lane[0] + lane[1]) + (lane[2] + lane[3])) / static_cast<double>(count) : 0.0;
    }
  };

  Sum of_others_, of_strays_;
  std::size_t lone_points_ = 0;
};

/** \brief One walk over the rows of the points begin ... end - 1.
 * \param edges receives the edges that only these list; has room for all and one more
 * \return the end of these edges
 */
template <typename Rows>
ReverseEdge* survey_rows(const OrderedPoints& points,
                         const NeighborGraph& graph,
                         const Rows& rows,
                         std::size_t begin,
                         std::size_t end,
                         float squared_reach_of_strays,
                         ReverseEdge* edges,
                         Lengths& lengths_of_rows)
{
  std::vector<float> squares(graph.stride + Lengths::lanes);
  Lengths lengths;  // written back at the end: those of other workers are close by in memory
  for (std::size_t i = begin; i < end; ++i) {
    const auto own = static_cast<std::uint32_t>(i);
    const NeighborSpan row = graph.nearest(i);
    const Eigen::Vector3f center = points.position[i];
    const float far2 = graph.reach[i].squared / (lone_reach * lone_reach);
    float* square = squares.data();
    for (const std::uint32_t j : row) *square++ = squared_distance(center, points.position[j]);
    std::fill_n(square, Lengths::lanes, 0.0F);
    square = squares.data();
    std::size_t outreached = 0;
    for (const std::uint32_t j : row) {
      // Without branches: every edge is written, and stays if the next place is beyond it.
      *edges = {j, own};
      edges += rows.lists(j, own, *square++) ? 0 : 1;
      outreached += graph.reach[j].squared < far2 ? 1 : 0;
    }
    lengths.add(squares.data(), row.size(), outreached, graph.reach[i].squared > squared_reach_of_strays);
  }
  lengths_of_rows = lengths;
  return edges;
}

/** \brief Measures the rows, and files edges that only one end lists with the other end as well. */
template <typename Rows>
void join_rows(const OrderedPoints& points, const Rows& rows, NeighborGraph& graph, const Parallel& parallel)
{
  ReverseEdges reverse(points.size(), parallel.threads());
  const float strays = stray_reach * stray_reach * typical_squared_reach(graph.reach);
  std::vector<Lengths> lengths_of_tile(reverse.tile_count());
  std::vector<PointArray<ReverseEdge>> edges_of_worker(parallel.threads());
  parallel.blocks(points.size(), reverse.tile_size(), [&](std::size_t begin, std::size_t end, unsigned worker) {
    PointArray<ReverseEdge>& edges = edges_of_worker[worker];
    edges.resize(reverse.tile_size() * graph.stride + 1);
    const std::size_t tile = begin / reverse.tile_size();
    const ReverseEdge* last = survey_rows(points, graph, rows, begin, end, strays, edges.data(), lengths_of_tile[tile]);
    reverse.add(worker, tile, edges.data(), static_cast<std::size_t>(last - edges.data()));
  });
  Lengths lengths;
  for (const Lengths& part : lengths_of_tile) lengths += part;
  graph.sampling_interval = lengths.mean();
  graph.lone_points = lengths.lone_points();
  reverse.file(graph, parallel);
}

}  // namespace

float typical_squared_reach(const PointArray<Reach>& reach)
{
  constexpr std::size_t stride = 16;
  if (reach.empty()) return 0;
  std::vector<float> sample;
  for (std::size_t i = 0; i < reach.size(); i += stride) sample.push_back(reach[i].squared);
  const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
  std::nth_element(sample.begin(), middle, sample.end());
  return *middle;
}

NeighborGraph list_neighbors(const OrderedPoints& points, const PointCloudView& cloud, int k, const Parallel& parallel)
{
  NeighborGraph graph;
  if (points.size() < 2) return graph;
  graph.stride = std::min<std::size_t>(static_cast<std::size_t>(k), points.size() - 1);
  find_own_neighbors(points, cloud, graph, parallel);
  graph.reach = measure_reach(points, graph, parallel);
  return graph;
}

void join_neighbors(const OrderedPoints& points,
                    const PointCloudView& cloud,
                    NeighborGraph& graph,
                    const Parallel& parallel)
{
  if (points.size() < 2)
    ReverseEdges(points.size(), 1).file(graph, parallel);
  else if (cloud.neighbor_search)
    join_rows(points, AnyRows(graph), graph, parallel);
  else if (!graph.own_count.empty())
    join_rows(points, PartedRows(graph), graph, parallel);
  else
    join_rows(points, CompleteRows(graph), graph, parallel);
}

NeighborGraph build_neighbor_graph(const OrderedPoints& points,
                                   const PointCloudView& cloud,
                                   int k,
                                   const Parallel& parallel)
{
  NeighborGraph graph = list_neighbors(points, cloud, k, parallel);
  join_neighbors(points, cloud, graph, parallel);
  return graph;
}

}  // namespace pds
