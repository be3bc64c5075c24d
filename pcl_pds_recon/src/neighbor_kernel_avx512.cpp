// SPDX-License-Identifier: BSD-3-Clause
#include "neighbor_kernel.h"

#if defined(__x86_64__)
#include <immintrin.h>
#include <limits>

// After the headers that other code shares, before the loops that are compiled here for this instruction set alone.
#if defined(__clang__)
#pragma clang attribute push(__attribute__((target("avx512f,avx512vl,avx512bw,avx512dq"))), apply_to = function)
#else
#pragma GCC target("avx512f,avx512vl,avx512bw,avx512dq")
#endif
#include "neighbor_lanes.h"

// Undefined registers in GCC 12's own header, bug 105593.
#if !defined(__clang__)
#pragma GCC diagnostic ignored "-Wuninitialized"
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

namespace pds
{
namespace
{

struct Avx512Lanes
{
  static constexpr std::size_t width = 16;

  static __m512 load(const float* from) { return _mm512_loadu_ps(from); }
  static __m512i load(const std::uint32_t* from) { return _mm512_loadu_si512(from); }
  static void store(__m512 value, float* to) { _mm512_storeu_ps(to, value); }
  static void store(__m512i value, std::uint32_t* to) { _mm512_storeu_si512(to, value); }
  static __m512 broadcast(float value) { return _mm512_set1_ps(value); }
  static __m512 max(__m512 a, __m512 b) { return _mm512_max_ps(a, b); }

  static __mmask16 less_equal(__m512 a, __m512 b) { return _mm512_cmp_ps_mask(a, b, _CMP_LE_OQ); }
  static std::size_t count(__mmask16 mask) { return static_cast<std::size_t>(__builtin_popcount(mask)); }

  // Compressing straight to memory is slower than a full store, for which there is room.
  static void compress(__mmask16 mask, __m512 value, float* to) { store(_mm512_maskz_compress_ps(mask, value), to); }
  static void compress(__mmask16 mask, __m512i value, std::uint32_t* to)
  {
    store(_mm512_maskz_compress_epi32(mask, value), to);
  }

  static __m512i zero_ranks() { return _mm512_setzero_si512(); }
  static __m512i count_less(__m512i ranks, __m512 a, __m512 b)
  {
    return _mm512_mask_add_epi32(ranks, _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ), ranks, _mm512_set1_epi32(1));
  }
  static __m512i add(__m512i a, __m512i b) { return _mm512_add_epi32(a, b); }
  static std::uint32_t total(__m512i ranks) { return static_cast<std::uint32_t>(_mm512_reduce_add_epi32(ranks)); }
};

}  // namespace

const NeighborKernel avx512_kernel{"avx512", boxes_within<Avx512Lanes>, filter_candidates<Avx512Lanes>,
                                   select_nearest<Avx512Lanes>};

}  // namespace pds

#if defined(__clang__)
#pragma clang attribute pop
#endif
#endif
