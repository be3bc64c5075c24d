// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl_pds_recon/parallel.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace pds
{

/** \brief The bits of a key that are sorted by: \a count bits from bit \a first on. */
struct KeyBits
{
  int first;
  int count;
};

/** \brief One pass of the sort: moves items to where their digit belongs, in the order in which they are. */
template <typename Item, typename DigitOf>
void scatter_by_digit(const Item* from,
                      Item* to,
                      std::size_t count,
                      std::size_t digits,
                      const DigitOf& digit_of,
                      const Parallel& parallel)
{
  // Blocks are large against their counters, and a few for each worker.
  const std::size_t block = std::max(16 * digits, count / (std::size_t{4} * parallel.threads()) + 1);
  std::vector<std::vector<std::size_t>> place((count + block - 1) / block);
  parallel.blocks(count, block, [&](std::size_t begin, std::size_t end, unsigned) {
    std::vector<std::size_t>& counter = place[begin / block];
    counter.assign(digits, 0);
    for (std::size_t i = begin; i < end; ++i) ++counter[digit_of(from[i])];
  });
  std::size_t sum = 0;
  for (std::size_t digit = 0; digit < digits; ++digit)
    for (std::vector<std::size_t>& counter : place) sum += std::exchange(counter[digit], sum);
  parallel.blocks(count, block, [&](std::size_t begin, std::size_t end, unsigned) {
    std::size_t* next = place[begin / block].data();
    for (std::size_t i = begin; i < end; ++i) to[next[digit_of(from[i])]++] = from[i];
  });
}

/** \brief Stable sort by some bits of the items' keys, least significant digit first.
 * \param items what to sort; overwritten
 * \param other an array as large
 * \param key_of unsigned key of an item
 * \return which of the two arrays holds the sorted items
 */
template <typename Item, typename KeyOf>
Item* radix_sort(
    Item* items, Item* other, std::size_t count, KeyBits bits, const KeyOf& key_of, const Parallel& parallel)
{
  constexpr int most_digit_bits = 11;  // 2048 counters stay in the first-level cache
  const int passes = (bits.count + most_digit_bits - 1) / most_digit_bits;
  for (int pass = 0; pass < passes; ++pass) {
    const int first = bits.count * pass / passes;
    const std::size_t digits = std::size_t{1} << (bits.count * (pass + 1) / passes - first);
    const int shift = bits.first + first;
    scatter_by_digit(
        items, other, count, digits,
        [&](const Item& item) { return static_cast<std::size_t>(key_of(item) >> shift) & (digits - 1); }, parallel);
    std::swap(items, other);
  }
  return items;
}

}  // namespace pds
