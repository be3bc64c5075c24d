// SPDX-License-Identifier: BSD-3-Clause
#include "neighbor_kernel.h"

#include <algorithm>
#include <numeric>
#include "neighbor_lanes.h"

namespace pds
{
namespace
{

/** \brief One lane, for processors without vector instructions that this library knows. */
struct ScalarLanes
{
  static constexpr std::size_t width = 1;

  static float load(const float* from) { return *from; }
  static std::uint32_t load(const std::uint32_t* from) { return *from; }
  static void store(float value, float* to) { *to = value; }
  static void store(std::uint32_t value, std::uint32_t* to) { *to = value; }
  static float broadcast(float value) { return value; }
  static float max(float a, float b) { return a > b ? a : b; }

  static bool less_equal(float a, float b) { return a <= b; }
  static std::size_t count(bool mask) { return mask ? 1 : 0; }

  // Without a branch: what does not count is overwritten by the next one.
  template <typename Value>
  static void compress(bool, Value value, Value* to)
  {
    *to = value;
  }

  static std::uint32_t zero_ranks() { return 0; }
  static std::uint32_t count_less(std::uint32_t rank, float a, float b) { return rank + (a < b ? 1U : 0U); }
  static std::uint32_t add(std::uint32_t a, std::uint32_t b) { return a + b; }
  static std::uint32_t total(std::uint32_t rank) { return rank; }
};

/** \brief Columns are read in pairs of registers and written in whole ones. */
std::size_t padded(std::size_t count) { return count + 2 * widest_register; }

}  // namespace

const NeighborKernel baseline_kernel{"baseline", boxes_within<ScalarLanes>, filter_candidates<ScalarLanes>,
                                     select_nearest<ScalarLanes>};

std::vector<const NeighborKernel*> neighbor_kernels()
{
  std::vector<const NeighborKernel*> kernels{&baseline_kernel};
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("popcnt")) kernels.push_back(&avx2_kernel);
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512dq"))
    kernels.push_back(&avx512_kernel);
#endif
  return kernels;
}

void sort_with_ties(const SelectionColumns& candidates, std::size_t count, std::uint32_t self)
{
  // Candidates of one rank, which ascend by index, take the places from this rank on.
  std::uint32_t* const next_place = candidates.next_place;
  std::iota(next_place, next_place + count, 0U);
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint32_t place = next_place[candidates.rank[i]]++;
    candidates.sorted_distance[place] = candidates.distance[i];
    candidates.sorted_index[place] = candidates.index[i];
  }
  // Points of smaller index that coincide with the query came before it.
  std::uint32_t* const own = std::find(candidates.sorted_index, candidates.sorted_index + count, self);
  std::rotate(candidates.sorted_index, own, own + 1);
}

CandidateBuffer::CandidateBuffer(std::size_t capacity) : coordinates_(3 * padded(capacity)), index_(padded(capacity))
{
  columns = {coordinates_.data(), coordinates_.data() + padded(capacity), coordinates_.data() + 2 * padded(capacity),
             index_.data(), 0};
}

SelectionBuffer::SelectionBuffer(std::size_t capacity)
    : distances_(2 * padded(capacity)), integers_(4 * padded(capacity))
{
  columns = {distances_.data(),
             integers_.data(),
             integers_.data() + padded(capacity),
             distances_.data() + padded(capacity),
             integers_.data() + 2 * padded(capacity),
             integers_.data() + 3 * padded(capacity)};
}

}  // namespace pds
