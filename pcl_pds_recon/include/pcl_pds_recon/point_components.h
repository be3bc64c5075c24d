// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <pcl_pds_recon/neighbor_graph.h>

namespace pds
{

/** \brief Points grouped by the edges that join them, however indirectly. */
struct PointComponents
{
  std::vector<std::size_t> begin;       ///< by component: its first place in point; size components + 1
  PointArray<std::uint32_t> point;      ///< ranks, ascending within a component
  PointArray<std::uint32_t> component;  ///< by rank

  /** \brief Number of components, which are in the order of their lowest ranks. */
  [[nodiscard]] std::size_t size() const { return begin.size() - 1; }
  /** \brief The points of one. */
  [[nodiscard]] NeighborSpan points_of(std::size_t c) const
  {
    return {point.data() + begin[c], point.data() + begin[c + 1]};
  }
};

/** \brief Finds the components of the graph. O(n k). */
[[nodiscard]] PointComponents find_components(const NeighborGraph& graph);

}  // namespace pds
