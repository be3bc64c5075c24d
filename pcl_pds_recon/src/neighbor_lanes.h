// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include "neighbor_kernel.h"

/** \brief The kernels' loops over vector registers, for the source files that say what a register is.
 *
 * Each of them compiles these for its own instruction set, hence the unnamed namespace. The order of operations is the
 * same for every width, and so is the result.
 */
namespace pds
{
namespace
{

/** \brief How far apart two intervals are; 0 if they overlap. */
template <typename Lanes, typename Floats>
Floats gap(Floats low_a, Floats high_a, Floats low_b, Floats high_b)
{
  return Lanes::max(Lanes::max(low_a - high_b, low_b - high_a), Lanes::broadcast(0.0F));
}

template <typename Lanes>
std::uint32_t boxes_within(const BoxColumns& boxes, const Box& box, float squared_reach)
{
  const auto reach = Lanes::broadcast(squared_reach);
  std::uint32_t within = 0;
  for (std::size_t i = 0; i < BoxColumns::size; i += Lanes::width) {
    const auto gap_along = [&](int axis) {
      return gap<Lanes>(Lanes::load(boxes.low[axis] + i), Lanes::load(boxes.high[axis] + i),
                        Lanes::broadcast(box.low[axis]), Lanes::broadcast(box.high[axis]));
    };
    const auto dx = gap_along(0);
    const auto dy = gap_along(1);
    const auto dz = gap_along(2);
    within |= static_cast<std::uint32_t>(Lanes::less_equal(dx * dx + dy * dy + dz * dz, reach)) << i;
  }
  return within;
}

template <typename Lanes>
void filter_candidates(const CandidateColumns& from, const Box& box, float squared_reach, CandidateColumns& to)
{
  const auto gap_along = [&box](int axis, auto coordinate) {
    return gap<Lanes>(coordinate, coordinate, Lanes::broadcast(box.low[axis]), Lanes::broadcast(box.high[axis]));
  };
  const auto reach = Lanes::broadcast(squared_reach);
  std::size_t count = 0;
  for (std::size_t i = 0; i < from.count; i += Lanes::width) {
    const auto x = Lanes::load(from.x + i);
    const auto y = Lanes::load(from.y + i);
    const auto z = Lanes::load(from.z + i);
    const auto dx = gap_along(0, x);
    const auto dy = gap_along(1, y);
    const auto dz = gap_along(2, z);
    const auto within = Lanes::less_equal(dx * dx + dy * dy + dz * dz, reach);
    Lanes::compress(within, x, to.x + count);
    Lanes::compress(within, y, to.y + count);
    Lanes::compress(within, z, to.z + count);
    Lanes::compress(within, Lanes::load(from.index + i), to.index + count);
    count += Lanes::count(within);
  }
  to.count = count;
  // Infinitely far away: what fills the last register but is no candidate.
  Lanes::store(Lanes::broadcast(std::numeric_limits<float>::infinity()), to.x + count);
}

/** \brief Collects distance and index of the candidates within the query's bound. \return how many there are */
template <typename Lanes>
std::size_t keep_near(const CandidateColumns& candidates, const NeighborQuery& query, const SelectionColumns& kept)
{
  const auto bound = Lanes::broadcast(query.squared_bound);
  std::size_t count = 0;
  for (std::size_t i = 0; i < candidates.count; i += Lanes::width) {
    const auto dx = Lanes::load(candidates.x + i) - Lanes::broadcast(query.x);
    const auto dy = Lanes::load(candidates.y + i) - Lanes::broadcast(query.y);
    const auto dz = Lanes::load(candidates.z + i) - Lanes::broadcast(query.z);
    const auto distance = dx * dx + dy * dy + dz * dz;
    const auto within = Lanes::less_equal(distance, bound);
    Lanes::compress(within, distance, kept.distance + count);
    Lanes::compress(within, Lanes::load(candidates.index + i), kept.index + count);
    count += Lanes::count(within);
  }
  return count;
}

/** \brief Ranks distances by counting smaller ones. \return true if all are different, so that ranks are too */
template <typename Lanes>
bool rank_by_counting(const float* distance, std::size_t count, std::uint32_t* rank)
{
  auto sum = Lanes::zero_ranks();
  std::size_t padded = 0;
  for (; padded < count; padded += 2 * Lanes::width) {  // two registers, to use every broadcast twice
    const auto left = Lanes::load(distance + padded);
    const auto right = Lanes::load(distance + padded + Lanes::width);
    auto left_rank = Lanes::zero_ranks();
    auto right_rank = Lanes::zero_ranks();
    for (std::size_t j = 0; j < count; ++j) {
      const auto other = Lanes::broadcast(distance[j]);
      left_rank = Lanes::count_less(left_rank, other, left);
      right_rank = Lanes::count_less(right_rank, other, right);
    }
    Lanes::store(left_rank, rank + padded);
    Lanes::store(right_rank, rank + padded + Lanes::width);
    sum = Lanes::add(sum, Lanes::add(left_rank, right_rank));
  }
  // The infinite distances of the padding have all others below them.
  const std::size_t expected = count * (count - 1) / 2 + (padded - count) * count;
  return Lanes::total(sum) == static_cast<std::uint32_t>(expected);
}

template <typename Lanes>
float select_nearest(const CandidateColumns& candidates,
                     const NeighborQuery& query,
                     std::size_t k,
                     const SelectionColumns& scratch,
                     std::uint32_t* nearest)
{
  constexpr float infinity = std::numeric_limits<float>::infinity();
  const std::size_t count = keep_near<Lanes>(candidates, query, scratch);
  if (count <= k) return infinity;  // the query itself is one of them
  Lanes::store(Lanes::broadcast(infinity), scratch.distance + count);
  Lanes::store(Lanes::broadcast(infinity), scratch.distance + count + Lanes::width);
  if (rank_by_counting<Lanes>(scratch.distance, count, scratch.rank)) {
    for (std::size_t i = 0; i < count; ++i) {
      scratch.sorted_distance[scratch.rank[i]] = scratch.distance[i];
      scratch.sorted_index[scratch.rank[i]] = scratch.index[i];
    }
  } else {
    sort_with_ties(scratch, count, query.self);
  }
  for (std::size_t j = 0; j < k; ++j) nearest[j] = scratch.sorted_index[j + 1];
  return scratch.sorted_distance[k];
}

}  // namespace
}  // namespace pds
