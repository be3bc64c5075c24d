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

/** \brief A point's nearest seed, and its distance in units of position. */
struct Label
{
  std::uint32_t seed;
  float distance;
};

/** \brief Labels points that thinning left out. */
class LabelsBeside
{
 public:
  LabelsBeside(const OrderedPoints& points, const PoissonDiskSampling& sampling)
  {
    for (const std::uint32_t rank : sampling.seeds) seed_position_.push_back(points.position[rank]);
  }

  /** \brief From the nearest seeds of the representative: it and the point see a seed in nearly the same direction, so
   * their distances from it go like the straight ones. */
  [[nodiscard]] Label label(const Eigen::Vector3f& point,
                            const Eigen::Vector3f& representative,
                            const NearestSeeds& nearest) const
  {
    Label label{nearest.seed[0], NearestSeeds::infinity};
    // What is farther from the representative by more than both ways to it and back remains farther.
    const float farthest = nearest.distance[0] + 2 * (point - representative).norm();
    for (std::size_t i = 0; i < NearestSeeds::capacity && nearest.seed[i] != NearestSeeds::none; ++i) {
      if (nearest.distance[i] > farthest) break;
      const Eigen::Vector3f& seed = seed_position_[nearest.seed[i]];
      const float there = (representative - seed).squaredNorm();
      const float here = (point - seed).squaredNorm();
      const float distance = there > 0 ? nearest.distance[i] * std::sqrt(here / there) : std::sqrt(here);
      if (distance < label.distance) label = {nearest.seed[i], distance};
    }
    return label;
  }

 private:
  std::vector<Eigen::Vector3f> seed_position_;  ///< side by side: all points' would not stay in the cache
};

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
  using Indices = std::vector<std::uint32_t>;
  constexpr std::size_t block = 32768;
  const std::size_t n = points.rank_of_input.size();
  result.voronoi.label.resize(n, no_label);
  result.voronoi.distance.resize(n, std::numeric_limits<float>::quiet_NaN());
  if (sampling.nearest.empty()) return;
  std::optional<LabelsBeside> beside;
  if (points.thinned_points > 0) beside.emplace(points, sampling);
  const auto describe = [&](std::size_t i, Indices& witnesses) {
    const std::uint32_t rank = points.rank_of_input[i];
    if (rank == no_rank) return;
    const NearestSeeds& nearest = sampling.nearest[rank];
    Label label{nearest.seed[0], nearest.distance[0]};
    if (beside && points.input_index[rank] != i) {
      const Eigen::Vector3f position = ((cloud.positions[i] - points.origin) / points.unit).cast<float>();
      label = beside->label(position, points.position[rank], nearest);
    }
    result.voronoi.label[i] = number_of_seed[label.seed];
    result.voronoi.distance[i] = static_cast<float>(static_cast<double>(label.distance) * points.unit);
    if (voronoi.witness[rank] != 0) witnesses.push_back(static_cast<std::uint32_t>(i));
  };
  const auto fetch = [&](std::size_t i) {
    const std::uint32_t rank = points.rank_of_input[i];
    if (rank == no_rank) return;
    __builtin_prefetch(&sampling.nearest[rank]);
    __builtin_prefetch(&points.position[rank]);
  };
  constexpr std::size_t ahead = 32;  // points that are described while one's seeds come from memory
  const auto describe_block = [&](std::size_t begin, std::size_t end, Indices& witnesses) {
    for (std::size_t i = begin; i < end; ++i) {
      if (i + ahead < end) fetch(i + ahead);
      describe(i, witnesses);
    }
  };
  for (const Indices& part : parallel_parts<Indices>(n, block, parallel, describe_block))
    append(result.witness_points, part);
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
