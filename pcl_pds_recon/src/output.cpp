// SPDX-License-Identifier: BSD-3-Clause
#include "output.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include "bucket_sort.h"
#include "parallel_parts.h"

namespace pds
{
namespace
{

constexpr std::size_t points_per_block = 32768;

/** \brief Brings faces into a canonical order: each begins with its lowest corner, and they ascend. */
std::vector<Triangle> sorted_faces(std::vector<Triangle> triangles, std::size_t vertex_count, const Parallel& parallel)
{
  constexpr std::size_t block = 4096;
  BucketSort by_first_corner(vertex_count);
  parallel.each(triangles.size(), block, [&](std::size_t f) {
    Triangle& t = triangles[f];
    std::rotate(t.begin(), std::min_element(t.begin(), t.end()), t.end());
    by_first_corner.count(t[0]);
  });
  const std::vector<std::size_t> begin = by_first_corner.begins();
  std::vector<Triangle> sorted(triangles.size());
  parallel.each(triangles.size(), block,
                [&](std::size_t f) { sorted[by_first_corner.place(triangles[f][0])] = triangles[f]; });
  parallel.each(vertex_count, block, [&](std::size_t v) {
    std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(begin[v]),
              sorted.begin() + static_cast<std::ptrdiff_t>(begin[v + 1]));
  });
  return sorted;
}

/** \brief A point's nearest seed by its number, and its distance in units of position. */
struct Label
{
  std::uint32_t seed;
  float distance;
};

/** \brief Labels of a cloud whose points all are there. What they need is side by side in memory: the input may have
 * any order, and then each point waits for its cache lines. */
class Labels
{
 public:
  Labels(const PoissonDiskSampling& sampling,
         const GeodesicVoronoi& voronoi,
         const std::vector<std::uint32_t>& number_of_seed,
         const Parallel& parallel)
      : entry_(sampling.nearest.size())
  {
    parallel.each(entry_.size(), points_per_block, [&](std::size_t rank) {
      const NearestSeeds& nearest = sampling.nearest[rank];
      entry_[rank] = {number_of_seed[nearest.seed[0]] << 1 | voronoi.witness[rank], nearest.distance[0]};
    });
  }

  void fetch(std::uint32_t rank) const { __builtin_prefetch(&entry_[rank]); }
  void fetch_seeds(std::uint32_t /*rank*/) const {}
  [[nodiscard]] bool is_witness(std::uint32_t rank) const { return (entry_[rank].seed_and_witness & 1) != 0; }
  [[nodiscard]] Label label(std::size_t /*input_index*/, std::uint32_t rank) const
  {
    return {entry_[rank].seed_and_witness >> 1, entry_[rank].distance};
  }

 private:
  struct Entry
  {
    std::uint32_t seed_and_witness;  ///< the latter in the lowest bit, for there are fewer than 2^31 seeds
    float distance;
  };

  PointArray<Entry> entry_;  ///< by rank
};

/** \brief The same if thinning has left points out, which are labelled by way of their representatives. */
class LabelsBeside
{
 public:
  LabelsBeside(const PointCloudView& cloud,
               const OrderedPoints& points,
               const PoissonDiskSampling& sampling,
               const GeodesicVoronoi& voronoi,
               const std::vector<std::uint32_t>& number_of_seed,
               const Parallel& parallel)
      : cloud_(cloud),
        origin_(points.origin),
        unit_(points.unit),
        seed_position_(sampling.seeds.size()),
        entry_(points.size())
  {
    for (std::size_t s = 0; s < sampling.seeds.size(); ++s)
      seed_position_[number_of_seed[s]] = points.position[sampling.seeds[s]];
    parallel.each(entry_.size(), points_per_block, [&](std::size_t rank) {
      Entry& entry = entry_[rank];
      entry = {sampling.nearest[rank], points.position[rank], points.input_index[rank], voronoi.witness[rank]};
      for (std::uint32_t& seed : entry.nearest.seed)
        if (seed != NearestSeeds::none) seed = number_of_seed[seed];
    });
  }

  void fetch(std::uint32_t rank) const { __builtin_prefetch(&entry_[rank]); }
  void fetch_seeds(std::uint32_t rank) const
  {
    for (const std::uint32_t seed : entry_[rank].nearest.seed)
      if (seed != NearestSeeds::none) __builtin_prefetch(&seed_position_[seed]);
  }
  [[nodiscard]] bool is_witness(std::uint32_t rank) const { return entry_[rank].witness != 0; }
  [[nodiscard]] Label label(std::size_t input_index, std::uint32_t rank) const
  {
    const Entry& entry = entry_[rank];
    if (entry.input_index == input_index) return {entry.nearest.seed[0], entry.nearest.distance[0]};
    const Eigen::Vector3f position = ((cloud_.positions[input_index] - origin_) / unit_).cast<float>();
    return label_beside(position, entry);
  }

 private:
  struct Entry
  {
    NearestSeeds nearest;  ///< by number
    Eigen::Vector3f position;
    std::uint32_t input_index;
    std::uint32_t witness;
    std::array<std::uint32_t, 5> unused{};  ///< a cache line in all
  };

  /** \brief From the nearest seeds of the representative: it and the point see a seed in nearly the same direction, so
   * their distances from it go like the straight ones. */
  [[nodiscard]] Label label_beside(const Eigen::Vector3f& point, const Entry& representative) const
  {
    const NearestSeeds& nearest = representative.nearest;
    Label label{nearest.seed[0], NearestSeeds::infinity};
    // What is farther from the representative by more than both ways to it and back remains farther.
    const float farthest = nearest.distance[0] + 2 * (point - representative.position).norm();
    for (std::size_t i = 0; i < NearestSeeds::capacity && nearest.seed[i] != NearestSeeds::none; ++i) {
      if (nearest.distance[i] > farthest) break;
      const Eigen::Vector3f& seed = seed_position_[nearest.seed[i]];
      const float there = (representative.position - seed).squaredNorm();
      const float here = (point - seed).squaredNorm();
      const float distance = there > 0 ? nearest.distance[i] * std::sqrt(here / there) : std::sqrt(here);
      if (distance < label.distance) label = {nearest.seed[i], distance};
    }
    return label;
  }

  const PointCloudView& cloud_;
  Eigen::Vector3d origin_;
  double unit_;
  std::vector<Eigen::Vector3f> seed_position_;  ///< by number
  PointArray<Entry> entry_;                     ///< by rank
};

/** \brief Labels each input point, and lists the witnesses. */
template <typename LabelsOfPoints>
void describe_with(const LabelsOfPoints& labels,
                   const OrderedPoints& points,
                   Reconstruction& result,
                   const Parallel& parallel)
{
  using Indices = std::vector<std::uint32_t>;
  // Points that are labelled while one's entry comes from memory, and then what the entry refers to.
  constexpr std::size_t far_ahead = 48;
  constexpr std::size_t ahead = 16;
  const auto label = [&](std::size_t i, Indices& witnesses) {
    const std::uint32_t rank = points.rank_of_input[i];
    if (rank == no_rank) return;
    const Label found = labels.label(i, rank);
    result.voronoi.label[i] = found.seed;
    result.voronoi.distance[i] = static_cast<float>(static_cast<double>(found.distance) * points.unit);
    if (labels.is_witness(rank)) witnesses.push_back(static_cast<std::uint32_t>(i));
  };
  const auto label_block = [&](std::size_t begin, std::size_t end, Indices& witnesses) {
    const auto rank_at = [&](std::size_t i) { return i < end ? points.rank_of_input[i] : no_rank; };
    for (std::size_t i = begin; i < end; ++i) {
      if (const std::uint32_t rank = rank_at(i + far_ahead); rank != no_rank) labels.fetch(rank);
      if (const std::uint32_t rank = rank_at(i + ahead); rank != no_rank) labels.fetch_seeds(rank);
      label(i, witnesses);
    }
  };
  for (const Indices& part :
       parallel_parts<Indices>(points.rank_of_input.size(), points_per_block, parallel, label_block))
    append(result.witness_points, part);
}

}  // namespace

std::vector<std::uint32_t> number_vertices(std::vector<Triangle> triangles,
                                           const OrderedPoints& points,
                                           const PoissonDiskSampling& sampling,
                                           Reconstruction& result,
                                           const Parallel& parallel)
{
  std::vector<std::uint32_t> number_of_seed(sampling.seeds.size());
  std::vector<std::uint8_t> used(sampling.seeds.size());
  for (const Triangle& t : triangles)
    for (const std::uint32_t s : t) used[s] = 1;
  result.seeds.reserve(used.size());
  for (const std::uint8_t wanted : {std::uint8_t{1}, std::uint8_t{0}})
    for (std::size_t s = 0; s < used.size(); ++s)
      if (used[s] == wanted) {
        number_of_seed[s] = static_cast<std::uint32_t>(result.seeds.size());
        result.seeds.push_back(points.input_index[sampling.seeds[s]]);
      }
  for (Triangle& t : triangles)
    for (std::uint32_t& v : t) v = number_of_seed[v];
  result.triangles = sorted_faces(std::move(triangles), used.size(), parallel);
  return number_of_seed;
}

std::vector<std::uint32_t> number_along_curves(const std::vector<Curve>& curves,
                                               const OrderedPoints& points,
                                               const PoissonDiskSampling& sampling,
                                               Reconstruction& result)
{
  std::vector<std::uint32_t> number_of_seed(sampling.seeds.size(), NearestSeeds::none);
  const auto number = [&](std::uint32_t seed) {
    number_of_seed[seed] = static_cast<std::uint32_t>(result.seeds.size());
    result.seeds.push_back(points.input_index[sampling.seeds[seed]]);
  };
  for (const Curve& curve : curves) {
    const auto first = static_cast<std::uint32_t>(result.seeds.size());
    for (const std::uint32_t seed : curve.seeds) number(seed);
    const auto last = static_cast<std::uint32_t>(result.seeds.size()) - 1;
    for (std::uint32_t v = first; v < last; ++v) result.segments.push_back({v, v + 1});
    if (curve.closed) result.segments.push_back({last, first});
  }
  for (std::uint32_t seed = 0; seed < number_of_seed.size(); ++seed)
    if (number_of_seed[seed] == NearestSeeds::none) number(seed);
  for (const auto& [a, b] : result.segments) result.seed_edges.push_back({std::min(a, b), std::max(a, b)});
  std::sort(result.seed_edges.begin(), result.seed_edges.end());
  return number_of_seed;
}

void describe_points(const PointCloudView& cloud,
                     const OrderedPoints& points,
                     const PoissonDiskSampling& sampling,
                     const GeodesicVoronoi& voronoi,
                     const std::vector<std::uint32_t>& number_of_seed,
                     Reconstruction& result,
                     const Parallel& parallel)
{
  const std::size_t n = points.rank_of_input.size();
  result.voronoi.label.resize(n, no_label);
  result.voronoi.distance.resize(n, std::numeric_limits<float>::quiet_NaN());
  if (sampling.nearest.empty()) return;
  if (points.thinned_points > 0)
    describe_with(LabelsBeside(cloud, points, sampling, voronoi, number_of_seed, parallel), points, result, parallel);
  else
    describe_with(Labels(sampling, voronoi, number_of_seed, parallel), points, result, parallel);
}

void describe_seed_graph(const SeedGraph& graph,
                         const std::vector<std::uint32_t>& number_of_seed,
                         Reconstruction& result,
                         const Parallel& parallel)
{
  using Edges = std::vector<std::array<std::uint32_t, 2>>;
  constexpr std::size_t block = 4096;
  std::vector<std::uint32_t> seed_of_number(number_of_seed.size());
  for (std::uint32_t s = 0; s < number_of_seed.size(); ++s) seed_of_number[number_of_seed[s]] = s;
  const auto describe = [&](std::uint32_t a, Edges& edges) {
    const std::uint32_t seed = seed_of_number[a];
    const auto first = static_cast<std::ptrdiff_t>(edges.size());
    for (std::size_t i = graph.begin[seed]; i < graph.begin[seed + 1]; ++i)
      if (const std::uint32_t b = number_of_seed[graph.neighbor[i]]; a < b) edges.push_back({a, b});
    std::sort(edges.begin() + first, edges.end());
  };
  for (const Edges& part : parallel_parts<Edges>(seed_of_number.size(), block, parallel,
                                                 [&](std::size_t begin, std::size_t end, Edges&edges) {
                                                   for (std::size_t a = begin; a < end; ++a)
                                                     describe(static_cast<std::uint32_t>(a), edges);
                                                 }))
    append(result.seed_edges, part);
}

void describe_moved_vertices(const std::vector<Eigen::Vector3d>& position,
                             const OrderedPoints& points,
                             const PoissonDiskSampling& sampling,
                             const GeodesicVoronoi& voronoi,
                             const std::vector<std::uint32_t>& number_of_seed,
                             Reconstruction& result)
{
  std::vector<std::uint32_t> seed_of_vertex(result.seeds.size());
  for (std::uint32_t s = 0; s < number_of_seed.size(); ++s) seed_of_vertex[number_of_seed[s]] = s;
  seed_of_vertex.resize(result.report.vertices);
  MovedVertices& moved = result.moved;
  moved.cell_begin = {0};
  for (const std::uint32_t s : seed_of_vertex) {
    moved.position.emplace_back(points.origin + sampling.radius * points.unit * position[s]);
    for (std::size_t i = voronoi.cell_begin[s]; i < voronoi.cell_begin[s + 1]; ++i)
      moved.cell_point.push_back(points.input_index[voronoi.cell_point[i]]);
    moved.cell_begin.push_back(moved.cell_point.size());
  }
}

}  // namespace pds
