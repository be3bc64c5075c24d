// SPDX-License-Identifier: BSD-3-Clause
#include "box_tree.h"

#include <limits>

namespace pds
{
namespace
{

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr Box empty_box{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

/** \brief A child that is missing is infinitely far from everything. */
void set_box(BoxColumns& boxes, std::size_t child, const Box& box)
{
  for (int axis = 0; axis < 3; ++axis) {
    boxes.low[axis][child] = box.low[axis];
    boxes.high[axis][child] = box.high[axis];
  }
}

}  // namespace

BoxTree::BoxTree(const PointArray<Eigen::Vector3f>& position, const NeighborKernel& kernel, const Parallel& parallel)
    : position_(position), kernel_(kernel)
{
  constexpr std::size_t block = 256;  // nodes, of 128 points at the lowest level
  const auto add_level = [&](std::size_t children, const auto& box_of_child) {
    std::vector<BoxColumns> nodes((children + node_size - 1) / node_size);
    parallel.each(nodes.size(), block, [&](std::size_t i) {
      for (std::size_t c = 0; c < node_size; ++c) {
        const std::size_t child = i * node_size + c;
        set_box(nodes[i], c, child < children ? box_of_child(child) : empty_box);
      }
    });
    level_.push_back(std::move(nodes));
  };
  add_level(leaf_count(), [&](std::size_t leaf) {
    Box box = empty_box;
    for (std::size_t i = leaf * leaf_size; i < leaf_end(leaf); ++i)
      for (int axis = 0; axis < 3; ++axis) {
        box.low[axis] = std::min(box.low[axis], position_[i][axis]);
        box.high[axis] = std::max(box.high[axis], position_[i][axis]);
      }
    return box;
  });
  while (level_.back().size() > 1)
    add_level(level_.back().size(), [&](std::size_t i) { return box_of(level_.back()[i], 0, node_size); });
}

Box BoxTree::box_of(const BoxColumns& node, std::size_t begin, std::size_t end)
{
  Box box = empty_box;
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t c = begin; c < end; ++c) {
      box.low[axis] = std::min(box.low[axis], node.low[axis][c]);
      box.high[axis] = std::max(box.high[axis], node.high[axis][c]);
    }
  return box;
}

Box BoxTree::box_of(std::size_t begin_leaf, std::size_t end_leaf) const
{
  const std::size_t node = begin_leaf / node_size;
  return box_of(level_.front()[node], begin_leaf - node * node_size, end_leaf - node * node_size);
}

BoxTree::Distances BoxTree::squared_distances(const BoxColumns& node, const Box& box)
{
  Distances sum{};
  for (int axis = 0; axis < 3; ++axis)
    for (std::size_t c = 0; c < node_size; ++c) {
      const float gap =
          std::max(std::max(node.low[axis][c] - box.high[axis], box.low[axis] - node.high[axis][c]), 0.0F);
      sum[c] += gap * gap;
    }
  return sum;
}

bool BoxTree::find_leaves(const Box& box,
                          float squared_reach,
                          std::size_t most,
                          std::vector<std::uint32_t>& leaves) const
{
  leaves.clear();
  find_leaves(level_.size() - 1, 0, box, squared_reach, most, leaves);
  return leaves.size() <= most;
}

void BoxTree::find_leaves(std::size_t level,
                          std::size_t number,
                          const Box& box,
                          float squared_reach,
                          std::size_t most,
                          std::vector<std::uint32_t>& leaves) const
{
  std::uint32_t within = kernel_.boxes_within(level_[level][number], box, squared_reach);
  for (; within != 0 && leaves.size() <= most; within &= within - 1) {
    const std::size_t child = number * node_size + static_cast<std::size_t>(__builtin_ctz(within));
    if (level == 0)
      leaves.push_back(static_cast<std::uint32_t>(child));
    else
      find_leaves(level - 1, child, box, squared_reach, most, leaves);
  }
}

std::size_t BoxTree::push_children(const Child& parent, const Box& box, float squared_bound, Child* stack) const
{
  const Distances distance = squared_distances(level_[parent.level - 1][parent.number], box);
  std::size_t count = 0;
  for (std::uint32_t c = 0; c < node_size; ++c)
    if (distance[c] <= squared_bound && distance[c] < infinity)
      stack[count++] = {distance[c], parent.level - 1, static_cast<std::uint32_t>(parent.number * node_size) + c};
  // The nearest last, where it is taken from.
  std::sort(stack, stack + count,
            [](const Child& a, const Child& b) { return a.squared_distance > b.squared_distance; });
  return count;
}

}  // namespace pds
