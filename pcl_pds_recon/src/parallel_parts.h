// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include <pcl_pds_recon/parallel.h>
#include <pcl_pds_recon/point_array.h>

namespace pds
{

/** \brief Bytes that processors take from each other as a whole: what different workers keep writing is this far apart.
 */
constexpr std::size_t cache_line = 64;

/** \brief Calls body(begin, end, part) for blocks of indices, each with a part of its own.
 * \return the parts in the order of the blocks, so that it does not matter who did what when */
template <typename Part, typename Body>
std::vector<Part> parallel_parts(std::size_t count, std::size_t block, const Parallel& parallel, const Body& body)
{
  std::vector<Part> parts((count + block - 1) / block);
  parallel.blocks(count, block, [&](std::size_t begin, std::size_t end, unsigned) {
    Part part{};  // written here and moved: parts side by side would share cache lines
    body(begin, end, part);
    parts[begin / block] = std::move(part);
  });
  return parts;
}

template <typename Item>
void append(std::vector<Item>& all, const std::vector<Item>& more)
{
  all.insert(all.end(), more.begin(), more.end());
}

/** \brief All items in one list. */
template <typename Item>
PointArray<Item> joined(std::vector<std::vector<Item>> parts, const Parallel& parallel)
{
  std::vector<std::size_t> begin{0};
  for (const std::vector<Item>& part : parts) begin.push_back(begin.back() + part.size());
  PointArray<Item> all(begin.back());
  parallel.each(parts.size(), 1, [&](std::size_t p) {
    std::copy(parts[p].begin(), parts[p].end(), all.begin() + static_cast<std::ptrdiff_t>(begin[p]));
    std::vector<Item>().swap(parts[p]);  // both lists whole would take twice the memory
  });
  return all;
}

}  // namespace pds
