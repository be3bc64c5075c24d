// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <pcl_pds_recon/parallel.h>
#include "neighbor_kernel.h"

namespace pds
{

/** \brief Bounding boxes over runs of consecutive points (leaves), over runs of these, and so on, sixteen to a node.
 *
 * Takes 3.2 bytes a point. Distances to boxes are computed as those between points are, and rounding is monotonic:
 * even as rounded, no point is nearer than its box.
 */
class BoxTree
{
 public:
  static constexpr std::size_t leaf_size = 8;  ///< points: few enough to have nearly the same neighbours
  static constexpr std::size_t node_size = BoxColumns::size;

  /** \param position points, best in Morton order; must outlive the tree */
  BoxTree(const PointArray<Eigen::Vector3f>& position, const NeighborKernel& kernel, const Parallel& parallel);

  [[nodiscard]] std::size_t leaf_count() const { return (position_.size() + leaf_size - 1) / leaf_size; }
  [[nodiscard]] std::size_t leaf_end(std::size_t leaf) const { return std::min((leaf + 1) * leaf_size, size()); }
  [[nodiscard]] std::size_t size() const { return position_.size(); }

  /** \brief Box of the leaves begin ... end - 1. */
  [[nodiscard]] Box box_of(std::size_t begin_leaf, std::size_t end_leaf) const;

  /** \brief Finds the leaves within a distance of a box, ascending; false if there are more than \a leaves has room
   * for. */
  bool find_leaves(const Box& box, float squared_reach, std::size_t most, std::vector<std::uint32_t>& leaves) const;

  /** \brief Calls visit(leaf) for all leaves within bound() of a point, roughly the nearest ones first; each visit may
   * lower the bound. */
  template <typename Bound, typename Visit>
  void visit_leaves(const Eigen::Vector3f& point, const Bound& squared_bound, const Visit& visit) const
  {
    const Box box{{point.x(), point.y(), point.z()}, {point.x(), point.y(), point.z()}};
    std::array<Child, most_levels * node_size> stack;
    stack[0] = {0.0F, static_cast<std::uint32_t>(level_.size()), 0};
    for (std::size_t depth = 1; depth > 0;) {
      const Child child = stack[--depth];
      if (child.squared_distance > squared_bound()) continue;
      if (child.level == 0) {
        visit(child.number);
        continue;
      }
      const auto first = stack.begin() + static_cast<std::ptrdiff_t>(depth);
      depth += push_children(child, box, squared_bound(), first);
    }
  }

 private:
  /** \brief A leaf, at level 0, or a node of level_[level - 1]. */
  struct Child
  {
    float squared_distance;
    std::uint32_t level;
    std::uint32_t number;
  };
  using Distances = std::array<float, node_size>;
  static constexpr std::size_t most_levels = 8;  // 16^8 leaves are more than an index can count

  static Distances squared_distances(const BoxColumns& node, const Box& box);
  static Box box_of(const BoxColumns& node, std::size_t begin, std::size_t end);
  void find_leaves(std::size_t level,
                   std::size_t number,
                   const Box& box,
                   float squared_reach,
                   std::size_t most,
                   std::vector<std::uint32_t>& leaves) const;
  std::size_t push_children(const Child& parent, const Box& box, float squared_bound, Child* stack) const;

  const PointArray<Eigen::Vector3f>& position_;
  const NeighborKernel& kernel_;
  std::vector<std::vector<BoxColumns>>
      level_;  ///< the first holds the boxes of the leaves, the last one is the root alone
};

}  // namespace pds
