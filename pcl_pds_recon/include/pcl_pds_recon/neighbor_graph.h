// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <pcl_pds_recon/ordered_points.h>
#include <pcl_pds_recon/parallel.h>

namespace pds
{

/** \brief A row of neighbours. */
struct NeighborSpan
{
  const std::uint32_t* first;
  const std::uint32_t* last;
  [[nodiscard]] const std::uint32_t* begin() const { return first; }
  [[nodiscard]] const std::uint32_t* end() const { return last; }
  [[nodiscard]] std::size_t size() const { return static_cast<std::size_t>(last - first); }
};

/** \brief Symmetric k-nearest-neighbour graph in compressed rows (paper, flowchart step 1).
 *
 * Each row lists the point's own k nearest neighbours by ascending distance, then the points that count it among theirs
 * by ascending rank. Equal distances are ordered by rank, so the graph does not depend on the input order.
 */
struct NeighborGraph
{
  std::vector<std::size_t> row_begin;    ///< size n + 1
  std::vector<std::uint32_t> neighbor;   ///< ranks
  std::vector<std::uint16_t> own_count;  ///< length of the leading part that are the point's own nearest neighbours
  double sampling_interval = 0;          ///< mean distance from a point to its own neighbours, in units of position

  [[nodiscard]] std::size_t size() const { return own_count.size(); }
  /** \brief All points joined to \a i by an edge. */
  [[nodiscard]] NeighborSpan neighbors(std::size_t i) const
  {
    return {neighbor.data() + row_begin[i], neighbor.data() + row_begin[i + 1]};
  }
  /** \brief The k nearest neighbours of \a i (fewer in a smaller cloud), nearest first. */
  [[nodiscard]] NeighborSpan nearest(std::size_t i) const
  {
    return {neighbor.data() + row_begin[i], neighbor.data() + row_begin[i] + own_count[i]};
  }
};

/** \brief Builds the graph with the library's own search, or with the one that the cloud brings. O(n k log n).
 * \param k neighbours per point, the point itself not counted
 */
[[nodiscard]] NeighborGraph build_neighbor_graph(const OrderedPoints& points,
                                                 const PointCloudView& cloud,
                                                 int k,
                                                 const Parallel& parallel);

}  // namespace pds
