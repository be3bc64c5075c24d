// SPDX-License-Identifier: BSD-3-Clause
#include "surface_sampling.h"

#include <algorithm>
#include <vector>

namespace pds
{
namespace
{

constexpr std::size_t most_samples = 256;

constexpr std::size_t fewest_neighbors = 12;  // random points of a plane have a growth of 1.42 lines then, with 8 1.3

// Growth of the median point over that on a line. Clean and noisy surfaces have 1.4 to 1.7, rows twice as far apart as
// the neighbours reach 1, 16 rays of a spinning lidar 1.2, clumps 0.5 to 0.8.
constexpr double least_over_line = 1.33;

/** \brief How many points are within two steps, over those within one. */
double growth(const NeighborGraph& graph, std::size_t i)
{
  const NeighborSpan row = graph.nearest(i);
  std::vector<std::uint32_t> reached(row.begin(), row.end());
  reached.push_back(static_cast<std::uint32_t>(i));
  const auto near = static_cast<double>(reached.size());
  for (const std::uint32_t j : row) {
    const NeighborSpan next = graph.nearest(j);
    reached.insert(reached.end(), next.begin(), next.end());
  }
  std::sort(reached.begin(), reached.end());
  return static_cast<double>(std::unique(reached.begin(), reached.end()) - reached.begin()) / near;
}

}  // namespace

bool is_sampled_as_surface(const NeighborGraph& graph, const Parallel& parallel)
{
  if (graph.size() == 0 || graph.stride < fewest_neighbors) return true;
  const std::size_t samples = std::min(graph.size(), most_samples);
  std::vector<double> growths(samples);
  constexpr std::size_t samples_per_block = 16;
  parallel.each(samples, samples_per_block,
                [&](std::size_t s) { growths[s] = growth(graph, s * graph.size() / samples); });
  const auto middle = growths.begin() + static_cast<std::ptrdiff_t>(samples / 2);
  std::nth_element(growths.begin(), middle, growths.end());
  const auto k = static_cast<double>(graph.stride);
  const double of_line = (2 * k + 1) / (k + 1);
  return *middle >= least_over_line * of_line;
}

}  // namespace pds
