// SPDX-License-Identifier: BSD-3-Clause
#include "representatives.h"

#include <numeric>
#include <utility>
#include <vector>

namespace pds
{
namespace
{

constexpr std::size_t block = 16384;  // points per block

/** \brief For each block of points, how many representatives come before it; behind the last one, their number. */
std::vector<std::size_t> before_blocks(const Representatives& representative, const Parallel& parallel)
{
  std::vector<std::size_t> before((representative.size() + block - 1) / block + 1);
  parallel.blocks(representative.size(), block, [&](std::size_t begin, std::size_t end, unsigned) {
    std::size_t count = 0;
    for (std::size_t i = begin; i < end; ++i) count += representative[i] == i ? 1U : 0U;
    before[begin / block + 1] = count;
  });
  std::partial_sum(before.begin(), before.end(), before.begin());
  return before;
}

}  // namespace

std::size_t count_representatives(const Representatives& representative, const Parallel& parallel)
{
  return before_blocks(representative, parallel).back();
}

OrderedPoints keep_representatives(OrderedPoints points,
                                   const Representatives& representative,
                                   const Parallel& parallel)
{
  const std::vector<std::size_t> before = before_blocks(representative, parallel);
  PointArray<std::uint32_t> new_rank(points.size());
  OrderedPoints left;
  left.position.resize(before.back());
  left.input_index.resize(before.back());
  parallel.blocks(points.size(), block, [&](std::size_t begin, std::size_t end, unsigned) {
    std::size_t next = before[begin / block];
    for (std::size_t i = begin; i < end; ++i) {
      if (representative[i] != i) continue;
      new_rank[i] = static_cast<std::uint32_t>(next);
      left.position[next] = points.position[i];
      left.input_index[next] = points.input_index[i];
      ++next;
    }
  });
  // Representatives are close by in memory; for the points of the input, in whatever order, one look must do.
  PointArray<std::uint32_t> rank_left(points.size());
  parallel.each(points.size(), block, [&](std::size_t i) { rank_left[i] = new_rank[representative[i]]; });
  left.rank_of_input = std::move(points.rank_of_input);
  parallel.each(left.rank_of_input.size(), block, [&](std::size_t i) {
    std::uint32_t& rank = left.rank_of_input[i];
    if (rank != no_rank) rank = rank_left[rank];
  });
  left.origin = points.origin;
  left.unit = points.unit;
  left.valid_points = points.valid_points;
  left.merged_points = points.merged_points;
  left.outliers = points.outliers;
  left.smoothed = points.smoothed;
  left.thinned_points = points.thinned_points + points.size() - left.size();
  return left;
}

}  // namespace pds
