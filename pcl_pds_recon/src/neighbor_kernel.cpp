// SPDX-License-Identifier: BSD-3-Clause
#include "neighbor_kernel.h"

#include <limits>
#include <numeric>

namespace pds
{
namespace
{

constexpr std::size_t register_floats = 16;  // of the widest register; columns are padded to whole registers

std::size_t padded(std::size_t count) { return (count + register_floats - 1) / register_floats * register_floats; }

[[gnu::always_inline]] inline float select(const CandidateColumns& candidates,
                                           const NeighborQuery& query,
                                           std::size_t k,
                                           SelectionScratch& scratch,
                                           std::uint32_t* __restrict nearest)
{
  const std::size_t count = candidates.count;
  const float* __restrict x = candidates.x.data();
  const float* __restrict y = candidates.y.data();
  const float* __restrict z = candidates.z.data();
  float* __restrict distance = scratch.squared_distance.data();
  for (std::size_t i = 0; i < padded(count); ++i) {
    const float dx = x[i] - query.x;
    const float dy = y[i] - query.y;
    const float dz = z[i] - query.z;
    distance[i] = dx * dx + dy * dy + dz * dz;
  }

  // Without branches: every candidate is written, and stays if the next place is beyond it.
  const std::uint32_t* __restrict index = candidates.index.data();
  float* __restrict kept = scratch.kept_distance.data();
  std::uint32_t* __restrict kept_index = scratch.kept_index.data();
  std::size_t kept_count = 0;
  for (std::size_t i = 0; i < count; ++i) {
    kept[kept_count] = distance[i];
    kept_index[kept_count] = index[i];
    kept_count += static_cast<std::size_t>((distance[i] <= query.squared_bound) & (index[i] != query.self));
  }
  for (std::size_t i = kept_count; i < padded(kept_count); ++i) kept[i] = std::numeric_limits<float>::infinity();

  if (kept_count < k) return std::numeric_limits<float>::infinity();

  // Candidates ascend by index, so of two equal distances the earlier one is nearer.
  std::uint32_t* __restrict rank = scratch.rank.data();
  const std::uint32_t* __restrict place = scratch.place.data();
  for (std::size_t i = 0; i < padded(kept_count); ++i) rank[i] = 0;
  for (std::size_t j = 0; j < kept_count; ++j) {
    const float d = kept[j];
    const std::uint32_t own = place[j];
    for (std::size_t i = 0; i < padded(kept_count); ++i)
      rank[i] += static_cast<std::uint32_t>(d < kept[i]) |
                 (static_cast<std::uint32_t>(d == kept[i]) & static_cast<std::uint32_t>(own < place[i]));
  }
  float last = 0;
  for (std::size_t i = 0; i < kept_count; ++i)
    if (rank[i] < k) {
      nearest[rank[i]] = kept_index[i];
      last = rank[i] + 1 == k ? kept[i] : last;
    }
  return last;
}

float select_baseline(
    const CandidateColumns& c, const NeighborQuery& q, std::size_t k, SelectionScratch& s, std::uint32_t* n)
{
  return select(c, q, k, s, n);
}

#if defined(__x86_64__)
[[gnu::target("avx2")]] float select_avx2(
    const CandidateColumns& c, const NeighborQuery& q, std::size_t k, SelectionScratch& s, std::uint32_t* n)
{
  return select(c, q, k, s, n);
}

#if defined(__clang__)
#define PDS_AVX512 "avx512f,avx512vl,avx512bw,avx512dq"
#else
#define PDS_AVX512 "avx512f,avx512vl,avx512bw,avx512dq,prefer-vector-width=512"
#endif
[[gnu::target(PDS_AVX512)]] float select_avx512(
    const CandidateColumns& c, const NeighborQuery& q, std::size_t k, SelectionScratch& s, std::uint32_t* n)
{
  return select(c, q, k, s, n);
}
#endif

}  // namespace

void CandidateColumns::reserve(std::size_t capacity)
{
  for (std::vector<float>* column : {&x, &y, &z}) column->assign(padded(capacity), 0.0F);
  index.assign(padded(capacity), 0);
}

InstructionSet best_instruction_set()
{
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512bw") &&
      __builtin_cpu_supports("avx512dq"))
    return InstructionSet::avx512;
  if (__builtin_cpu_supports("avx2")) return InstructionSet::avx2;
#endif
  return InstructionSet::baseline;
}

float select_nearest(InstructionSet set,
                     const CandidateColumns& candidates,
                     const NeighborQuery& query,
                     std::size_t k,
                     SelectionScratch& scratch,
                     std::uint32_t* nearest)
{
  const std::size_t room = padded(candidates.count) + register_floats;
  if (scratch.rank.size() < room) {
    scratch.squared_distance.resize(room);
    scratch.kept_distance.resize(room);
    scratch.kept_index.resize(room);
    scratch.rank.resize(room);
    scratch.place.resize(room);
    std::iota(scratch.place.begin(), scratch.place.end(), 0U);
  }
#if defined(__x86_64__)
  if (set == InstructionSet::avx512) return select_avx512(candidates, query, k, scratch, nearest);
  if (set == InstructionSet::avx2) return select_avx2(candidates, query, k, scratch, nearest);
#endif
  static_cast<void>(set);
  return select_baseline(candidates, query, k, scratch, nearest);
}

}  // namespace pds
