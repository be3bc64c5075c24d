// SPDX-License-Identifier: BSD-3-Clause
#include "neighbor_kernel.h"

#if defined(__x86_64__)
#include <immintrin.h>
#include <limits>

// After the headers that other code shares, before the loops that are compiled here for this instruction set alone.
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx2,popcnt"))), apply_to = function)
#else
#pragma GCC target("avx2,popcnt")
#endif
#include "neighbor_lanes.h"

namespace pds
{
namespace
{

/** \brief For every mask of eight lanes: the lanes that are set, in their order, then any. */
struct CompressTable
{
  std::uint8_t lane[256][8];

  constexpr CompressTable() : lane()
  {
    for (unsigned mask = 0; mask < 256; ++mask) {
      unsigned count = 0;
      for (std::uint8_t i = 0; i < 8; ++i)
        if ((mask >> i & 1U) != 0) lane[mask][count++] = i;
    }
  }
};
constexpr CompressTable compress_table;

struct Avx2Lanes
{
  static constexpr std::size_t width = 8;

  static __m256 load(const float* from) { return _mm256_loadu_ps(from); }
  static __m256i load(const std::uint32_t* from) { return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(from)); }
  static void store(__m256 value, float* to) { _mm256_storeu_ps(to, value); }
  static void store(__m256i value, std::uint32_t* to) { _mm256_storeu_si256(reinterpret_cast<__m256i*>(to), value); }
  static __m256 broadcast(float value) { return _mm256_set1_ps(value); }
  static __m256 max(__m256 a, __m256 b) { return _mm256_max_ps(a, b); }

  static unsigned less_equal(__m256 a, __m256 b)
  {
    return static_cast<unsigned>(_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LE_OQ)));
  }
  static std::size_t count(unsigned mask) { return static_cast<std::size_t>(__builtin_popcount(mask)); }

  static void compress(unsigned mask, __m256 value, float* to)
  {
    store(_mm256_permutevar8x32_ps(value, lanes_of(mask)), to);
  }
  static void compress(unsigned mask, __m256i value, std::uint32_t* to)
  {
    store(_mm256_permutevar8x32_epi32(value, lanes_of(mask)), to);
  }

  static __m256i zero_ranks() { return _mm256_setzero_si256(); }
  static __m256i count_less(__m256i ranks, __m256 a, __m256 b)
  {
    return _mm256_sub_epi32(ranks, _mm256_castps_si256(_mm256_cmp_ps(a, b, _CMP_LT_OQ)));  // true is -1
  }
  static __m256i add(__m256i a, __m256i b) { return _mm256_add_epi32(a, b); }
  static std::uint32_t total(__m256i ranks)
  {
    std::uint32_t lane[width];
    store(ranks, lane);
    std::uint32_t sum = 0;
    for (const std::uint32_t rank : lane) sum += rank;
    return sum;
  }

 private:
  static __m256i lanes_of(unsigned mask)
  {
    return _mm256_cvtepu8_epi32(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(compress_table.lane[mask])));
  }
};

}  // namespace

const NeighborKernel avx2_kernel{"avx2", boxes_within<Avx2Lanes>, filter_candidates<Avx2Lanes>,
                                 select_nearest<Avx2Lanes>};

}  // namespace pds

#if defined(__clang__)
#pragma clang attribute pop
#endif
#endif
