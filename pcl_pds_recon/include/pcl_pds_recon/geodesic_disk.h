// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <vector>

#include <pcl_pds_recon/edge_weights.h>
#include <pcl_pds_recon/neighbor_graph.h>
#include <pcl_pds_recon/options.h>
#include <pcl_pds_recon/ordered_points.h>

namespace pds
{

/** \brief Grows geodesic disks on the neighbourhood graph by fast marching (paper, flowchart step 3).
 *
 * A point is settled in order of distance, as in Dijkstra's method, but its distance also takes the two-point update:
 * two settled neighbours a and b fix the source's place in the plane of the triangle (a, b, p), and the distance is the
 * straight line from there. Where no source fits, the shortest edge path counts. No distance falls below the
 * Euclidean one.
 *
 * An object holds the working memory of one thread; its size follows the largest disk grown.
 */
class GeodesicDisk
{
 public:
  /** \brief A point reached, and its distance in units of position. */
  struct Reached
  {
    std::uint32_t point;
    float distance;
  };

  GeodesicDisk(const OrderedPoints& points,
               const NeighborGraph& graph,
               const EdgeWeights& weights,
               GeodesicSolver solver);

  /** \brief Settles all points within \a limit of \a source, nearest first. O(m k log m) for m points.
   * \return the points reached, the source first; valid until the next call
   */
  const std::vector<Reached>& grow(std::uint32_t source, float limit);

 private:
  static constexpr std::uint32_t none = 0xffffffffU;

  /** \brief What is known of a point that the front has touched. */
  struct Node
  {
    std::uint32_t point = none;
    std::uint32_t nearest = none;  ///< node of the settled neighbour that gave the shortest edge path
    float path = 0;                ///< length of that path
    float distance = 0;            ///< best distance so far
    float lower_bound = 0;         ///< straight from the source at the least weight
    bool settled = false;
  };

  /** \brief An entry of the front; a point's outdated entries are skipped when they come up. */
  struct Front
  {
    float distance;
    std::uint32_t point;
    std::uint32_t node;
  };

  std::uint32_t find_or_add(std::uint32_t point);
  void grow_table();
  void push(std::uint32_t node);
  void relax_neighbors(std::uint32_t settled_node, float limit);
  void relax(std::uint32_t settled_node, std::uint32_t node);

  const OrderedPoints& points_;
  const NeighborGraph& graph_;
  const EdgeWeights& weights_;
  GeodesicSolver solver_;
  float good_enough_;
  Eigen::Vector3f source_position_{0, 0, 0};
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> table_;  ///< open addressing: point -> node
  std::vector<Front> front_;          ///< binary heap
  std::vector<Reached> reached_;
};

}  // namespace pds
