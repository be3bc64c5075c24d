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

float distance(std::uint32_t a, std::uint32_t b, const OrderedPoints& points)
{
  return (points.position[a] - points.position[b]).norm();
}

/** \brief The sampling interval at one point after the other. Holds the working memory of one thread. */
class LocalInterval
{
 public:
  LocalInterval(const OrderedPoints& points, const NeighborGraph& graph) : points_(points), graph_(graph) {}

  /** \brief A bound of at() that takes less. */
  [[nodiscard]] float at_most(std::uint32_t point)
  {
    return common(point, [this](std::uint32_t p) { return reach(p); });
  }
  [[nodiscard]] float at(std::uint32_t point)
  {
    return common(point, [this](std::uint32_t p) { return interval(p); });
  }

 private:
  /** \brief The third largest of the lengths at a point, at its neighbours and at those that it is a neighbour of. A
   * stray is beside points with short ones, and no neighbour of theirs; where sparse points begin beside dense ones,
   * some of either are. */
  template <typename Length>
  float common(std::uint32_t point, const Length& length)
  {
    constexpr std::size_t others = 2;
    lengths_.assign(1, length(point));
    for (const std::uint32_t j : graph_.neighbors(point)) lengths_.push_back(length(j));
    const auto place = lengths_.begin() + static_cast<std::ptrdiff_t>(std::min(others, lengths_.size() - 1));
    std::nth_element(lengths_.begin(), place, lengths_.end(), std::greater<>());
    return *place;
  }

  /** \brief How far a point's own neighbours are away in the mean. */
  [[nodiscard]] float interval(std::uint32_t point) const
  {
    const NeighborSpan nearest = graph_.nearest(point);
    float sum = 0;
    for (const std::uint32_t j : nearest) sum += distance(point, j, points_);
    return nearest.size() > 0 ? sum / static_cast<float>(nearest.size()) : 0.0F;
  }

  /** \brief And how far the last one is. */
  [[nodiscard]] float reach(std::uint32_t point) const
  {
    const NeighborSpan nearest = graph_.nearest(point);
    return nearest.size() > 0 ? distance(point, *(nearest.end() - 1), points_) : 0.0F;
  }

  const OrderedPoints& points_;
  const NeighborGraph& graph_;
  std::vector<float> lengths_;
};

}  // namespace

std::vector<float> local_sparsity(const OrderedPoints& points,
                                  const NeighborGraph& graph,
                                  const PoissonDiskSampling& sampling,
                                  const Parallel& parallel)
{
  constexpr std::size_t block = 1024;
  std::vector<float> sparsity(sampling.seeds.size(), 1.0F);
  const auto per_radius = static_cast<float>(smallest_disk / sampling.radius);
  parallel.blocks(sparsity.size(), block, [&](std::size_t begin, std::size_t end, unsigned) {
    LocalInterval interval(points, graph);
    for (std::size_t s = begin; s < end; ++s)
      if (per_radius * interval.at_most(sampling.seeds[s]) > 1)
        sparsity[s] = std::max(1.0F, per_radius * interval.at(sampling.seeds[s]));
  });
  return sparsity;
}

}  // namespace pds
