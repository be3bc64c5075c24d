// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include <pcl_pds_recon/geodesic_voronoi.h>
#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/point_array.h>
#include "bucket_sort.h"

namespace pds
{

/** \brief Orders what has the same lowest seed, and is the same for the same thing. */
inline std::uint64_t key_of(const SeedPair& p) { return p.b; }
inline std::uint64_t key_of(const SeedTriple& t)
{
  constexpr unsigned seed_bits = 32;
  return std::uint64_t{t.b} << seed_bits | t.c;
}

/** \brief Adds up two pieces of evidence for the same thing. Neither sum nor minimum depends on their order. */
inline void add_up(SeedPair& sum, const SeedPair& more)
{
  sum.witnesses += more.witnesses;
  sum.path = std::min(sum.path, more.path);
}
inline void add_up(SeedTriple& sum, const SeedTriple& more) { sum.votes += more.votes; }

/** \brief Evidence as several cells saw it, in any order, sorted, with one piece of evidence for each thing.
 * \param seen lists that one worker each has written; freed as soon as may be
 * \param keep says whether a piece may stay
 */
template <typename Evidence, typename Keep>
std::vector<Evidence> merge_evidence(std::vector<PointArray<Evidence>> seen,
                                     std::size_t seed_count,
                                     const Keep& keep,
                                     const Parallel& parallel)
{
  constexpr std::size_t seeds_per_block = 1024;
  BucketSort by_first_seed(seed_count);
  parallel.each(seen.size(), 1, [&](std::size_t list) {
    for (const Evidence& e : seen[list]) by_first_seed.count(e.a);
  });
  const std::vector<std::size_t> begin = by_first_seed.begins();
  PointArray<Evidence> sorted(begin.back());
  parallel.each(seen.size(), 1, [&](std::size_t list) {
    for (const Evidence& e : seen[list]) sorted[by_first_seed.place(e.a)] = e;
  });
  seen.clear();

  std::vector<std::size_t> merged_begin(seed_count + 1);
  parallel.each(seed_count, seeds_per_block, [&](std::size_t s) {
    const auto first = sorted.begin() + static_cast<std::ptrdiff_t>(begin[s]);
    const auto last = sorted.begin() + static_cast<std::ptrdiff_t>(begin[s + 1]);
    std::sort(first, last, [](const Evidence& x, const Evidence& y) { return key_of(x) < key_of(y); });
    auto end = first;
    for (auto e = first; e != last; ++e) {
      if (end != first && key_of(*(end - 1)) == key_of(*e))
        add_up(*(end - 1), *e);
      else if (keep(*e))
        *end++ = *e;
    }
    merged_begin[s + 1] = static_cast<std::size_t>(end - first);
  });
  for (std::size_t s = 0; s < seed_count; ++s) merged_begin[s + 1] += merged_begin[s];
  std::vector<Evidence> merged(merged_begin.back());
  parallel.each(seed_count, seeds_per_block, [&](std::size_t s) {
    std::copy_n(sorted.begin() + static_cast<std::ptrdiff_t>(begin[s]), merged_begin[s + 1] - merged_begin[s],
                merged.begin() + static_cast<std::ptrdiff_t>(merged_begin[s]));
  });
  return merged;
}

}  // namespace pds
