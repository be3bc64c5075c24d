// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

#include <pcl_pds_recon/parallel.h>

namespace pds
{

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

}  // namespace pds
