// SPDX-License-Identifier: BSD-3-Clause
#include "local_sparsity.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>

namespace pds
{
namespace
{

constexpr float smallest_disk = 1.6F;  // intervals; as the adaptive metric has it
// Radii: what is sparser is likely no surface. From 4 on curtains of mixed pixels, which hang between a silhouette and
// what is behind it, get faces.
constexpr float sparsest = 3.0F;
constexpr std::size_t large_cell = 9;  // points; a radius of smallest_disk gives 8 in the mean, the default one 29

/** \brief The sampling interval at one point after the other. Holds the working memory of one thread. */
class LocalInterval
{
 public:
  LocalInterval(const OrderedPoints& points, const NeighborGraph& graph) : points_(points), graph_(graph) {}

  /** \brief The third largest of the intervals at a point, at its neighbours and at those that it is a neighbour of. A
   * stray is beside points with short ones, and no neighbour of theirs. */
  [[nodiscard]] float at(std::uint32_t point)
  {
    constexpr std::size_t others = 2;
    intervals_.assign(1, own(point));
    for (const std::uint32_t j : graph_.neighbors(point)) intervals_.push_back(own(j));
    const auto place = intervals_.begin() + static_cast<std::ptrdiff_t>(std::min(others, intervals_.size() - 1));
    std::nth_element(intervals_.begin(), place, intervals_.end(), std::greater<>());
    return *place;
  }

 private:
  /** \brief How far a point's own neighbours are away in the mean. */
  [[nodiscard]] float own(std::uint32_t point) const
  {
    const NeighborSpan nearest = graph_.nearest(point);
    float sum = 0;
    for (const std::uint32_t j : nearest) sum += (points_.position[j] - points_.position[point]).norm();
    return nearest.size() > 0 ? sum / static_cast<float>(nearest.size()) : 0.0F;
  }

  const OrderedPoints& points_;
  const NeighborGraph& graph_;
  std::vector<float> intervals_;
};

}  // namespace

std::vector<float> local_sparsity(const OrderedPoints& points,
                                  const NeighborGraph& graph,
                                  const PoissonDiskSampling& sampling,
                                  const std::vector<std::size_t>& cell_begin,
                                  const Parallel& parallel)
{
  constexpr std::size_t block = 1024;
  std::vector<float> sparsity(sampling.seeds.size(), 1.0F);
  const auto per_radius = static_cast<float>(smallest_disk / sampling.radius);
  parallel.blocks(sparsity.size(), block, [&](std::size_t begin, std::size_t end, unsigned) {
    LocalInterval interval(points, graph);
    for (std::size_t s = begin; s < end; ++s)
      if (cell_begin[s + 1] - cell_begin[s] < large_cell)
        sparsity[s] = std::clamp(per_radius * interval.at(sampling.seeds[s]), 1.0F, sparsest);
  });
  return sparsity;
}

}  // namespace pds
