// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/nearest_neighbors.h>

#include <algorithm>
#include <limits>
#include <utility>
#include "box_tree.h"
#include "neighbor_kernel.h"
#include "parallel_parts.h"

namespace pds
{
namespace
{

constexpr float infinity = std::numeric_limits<float>::infinity();

/** \brief Searches for one point at a time, whatever the cloud looks like around it. */
class SingleSearch
{
 public:
  SingleSearch(const BoxTree& tree, const PointArray<Eigen::Vector3f>& position, std::size_t k)
      : tree_(tree), position_(position), best_(k)
  {
  }

  /** \return the squared distance of the k-th neighbour */
  float search(std::uint32_t query, std::uint32_t* row)
  {
    std::fill(best_.begin(), best_.end(), Candidate{infinity, std::numeric_limits<std::uint32_t>::max()});
    const Eigen::Vector3f& q = position_[query];
    const auto worst = [this] { return best_.back().first; };
    tree_.visit_leaves(q, worst, [&](std::size_t leaf) {
      for (std::size_t i = leaf * BoxTree::leaf_size; i < tree_.leaf_end(leaf); ++i) {
        const Eigen::Vector3f d = position_[i] - q;
        const float squared_distance = d.x() * d.x() + d.y() * d.y() + d.z() * d.z();
        if (squared_distance <= worst() && i != query) insert({squared_distance, static_cast<std::uint32_t>(i)});
      }
    });
    for (const Candidate& candidate : best_) *row++ = candidate.second;
    return worst();
  }

 private:
  using Candidate = std::pair<float, std::uint32_t>;  // squared distance, index

  void insert(const Candidate& candidate)
  {
    if (candidate >= best_.back()) return;
    std::size_t place = best_.size() - 1;
    for (; place > 0 && best_[place - 1] > candidate; --place) best_[place] = best_[place - 1];
    best_[place] = candidate;
  }

  const BoxTree& tree_;
  const PointArray<Eigen::Vector3f>& position_;
  std::vector<Candidate> best_;  ///< ascending
};

/** \brief Searches for the points of consecutive leaves together: they share their candidates.
 *
 * All points within a guessed reach of the leaves are candidates. A query that finds k of them within the reach has
 * found its true neighbours, for every other point is farther away; one that does not gathers candidates of its own.
 * Guesses come from the points just before, which are close by, and cost time if they are wrong, but change no result.
 */
class GroupSearch
{
 public:
  GroupSearch(const BoxTree& tree,
              const PointArray<Eigen::Vector3f>& position,
              std::size_t k,
              const NeighborKernel& kernel)
      : tree_(tree),
        position_(position),
        k_(k),
        kernel_(kernel),
        single_(tree, position, k),
        most_leaves_(leaves_per_neighbor * (k + 1)),
        of_group_(most_leaves_ * BoxTree::leaf_size),
        of_leaf_(most_leaves_ * BoxTree::leaf_size),
        of_point_(most_leaves_ * BoxTree::leaf_size),
        selection_(most_leaves_ * BoxTree::leaf_size)
  {
  }

  /** \param rows receives k indices for every point of the leaves */
  void search(std::size_t begin_leaf, std::size_t end_leaf, std::uint32_t* rows)
  {
    if (expected_ <= 0) {
      expected_ = single_.search(static_cast<std::uint32_t>(begin_leaf * BoxTree::leaf_size), rows);
    }
    const float squared_reach = reach_growth * expected_;
    if (gather(tree_.box_of(begin_leaf, end_leaf), squared_reach, of_group_.columns)) {
      for (std::size_t leaf = begin_leaf; leaf < end_leaf; ++leaf) {
        kernel_.filter(of_group_.columns, tree_.box_of(leaf, leaf + 1), squared_reach, of_leaf_.columns);
        search_leaf(leaf, squared_reach, rows_of(leaf, begin_leaf, rows));
      }
    } else if (end_leaf - begin_leaf > 1) {
      const std::size_t middle = (begin_leaf + end_leaf) / 2;
      search(begin_leaf, middle, rows);
      search(middle, end_leaf, rows_of(middle, begin_leaf, rows));
    } else {
      of_leaf_.columns.count = 0;
      search_leaf(begin_leaf, 0.0F, rows);
    }
  }

 private:
  static constexpr std::size_t leaves_per_neighbor = 8;  // twice as many candidates as a group has on a surface
  static constexpr int most_widenings = 6;               // 64 times the area; what needs more is a stray point
  // On random points of a surface, of the expected squared distance of the k-th neighbour: 1.5 hold enough neighbours
  // for 97 of 100 points, 2.2 for 99, and few superfluous ones.
  static constexpr float bound_growth = 1.5F;
  static constexpr float reach_growth = 2.2F;

  [[nodiscard]] std::uint32_t* rows_of(std::size_t leaf, std::size_t first_leaf, std::uint32_t* rows) const
  {
    return rows + (leaf - first_leaf) * BoxTree::leaf_size * k_;
  }

  /** \brief Collects the points of all leaves within reach of a box; false if these are too many. */
  bool gather(const Box& box, float squared_reach, CandidateColumns& to)
  {
    if (!tree_.find_leaves(box, squared_reach, most_leaves_, leaves_)) return false;
    to.count = 0;
    for (const std::uint32_t leaf : leaves_)
      for (std::size_t i = leaf * BoxTree::leaf_size; i < tree_.leaf_end(leaf); ++i, ++to.count) {
        to.x[to.count] = position_[i].x();
        to.y[to.count] = position_[i].y();
        to.z[to.count] = position_[i].z();
        to.index[to.count] = static_cast<std::uint32_t>(i);
      }
    std::fill_n(to.x + to.count, widest_register, infinity);
    return true;
  }

  void search_leaf(std::size_t leaf, float squared_reach, std::uint32_t* rows)
  {
    for (std::size_t i = leaf * BoxTree::leaf_size; i < tree_.leaf_end(leaf); ++i, rows += k_)
      expect(search_point(static_cast<std::uint32_t>(i), squared_reach, rows));
  }

  /** \brief Learns from a point's result: slowly to expect more, which a single stray must not do, fast to expect less.
   */
  void expect(float squared_distance)
  {
    const float smoothed = 0.75F * expected_ + 0.25F * std::min(squared_distance, 2 * expected_);
    expected_ = std::min(smoothed, 2 * squared_distance);
  }

  /** \return the squared distance of the k-th neighbour */
  float search_point(std::uint32_t i, float squared_reach, std::uint32_t* row)
  {
    const float bound = std::min(bound_growth * expected_, squared_reach);
    float last = select(of_leaf_.columns, i, bound, row);
    if (last == infinity && bound < squared_reach) last = select(of_leaf_.columns, i, squared_reach, row);
    return last == infinity ? search_wider(i, std::max(squared_reach, expected_), row) : last;
  }

  float search_wider(std::uint32_t i, float squared_reach, std::uint32_t* row)
  {
    const Eigen::Vector3f& q = position_[i];
    for (int widening = 0; widening < most_widenings; ++widening) {
      squared_reach *= 2;
      if (!gather({{q.x(), q.y(), q.z()}, {q.x(), q.y(), q.z()}}, squared_reach, of_point_.columns)) break;
      const float last = select(of_point_.columns, i, squared_reach, row);
      if (last < infinity) return last;
    }
    return single_.search(i, row);
  }

  float select(const CandidateColumns& candidates, std::uint32_t i, float squared_bound, std::uint32_t* row)
  {
    const Eigen::Vector3f& q = position_[i];
    return kernel_.select(candidates, {q.x(), q.y(), q.z(), i, squared_bound}, k_, selection_.columns, row);
  }

  const BoxTree& tree_;
  const PointArray<Eigen::Vector3f>& position_;
  std::size_t k_;
  const NeighborKernel& kernel_;
  SingleSearch single_;
  std::size_t most_leaves_;
  float expected_ = 0;  ///< squared distance of the next point's k-th neighbour; 0 = no guess
  std::vector<std::uint32_t> leaves_;
  CandidateBuffer of_group_, of_leaf_, of_point_;
  SelectionBuffer selection_;
};

float mean_distance(const PointArray<Eigen::Vector3f>& position, std::size_t i, const std::uint32_t* row, std::size_t k)
{
  float sum = 0;
  for (std::size_t j = 0; j < k; ++j) sum += (position[row[j]] - position[i]).norm();
  return sum / static_cast<float>(k);
}

}  // namespace

PointArray<std::uint32_t> nearest_neighbors(const PointArray<Eigen::Vector3f>& position,
                                            std::size_t k,
                                            const NeighborKernel& kernel,
                                            const Parallel& parallel)
{
  constexpr std::size_t leaves_per_group = 8;
  constexpr std::size_t leaves_per_block = 512;  // half a millisecond of work
  const BoxTree tree(position, kernel, parallel);
  PointArray<std::uint32_t> neighbors(position.size() * k);
  parallel.blocks(tree.leaf_count(), leaves_per_block, [&](std::size_t begin, std::size_t end, unsigned) {
    GroupSearch search(tree, position, k, kernel);
    for (std::size_t leaf = begin; leaf < end; leaf += leaves_per_group)
      search.search(leaf, std::min(leaf + leaves_per_group, end), neighbors.data() + leaf * BoxTree::leaf_size * k);
  });
  return neighbors;
}

PointArray<std::uint32_t> nearest_neighbors(const PointArray<Eigen::Vector3f>& position,
                                            std::size_t k,
                                            const Parallel& parallel)
{
  return nearest_neighbors(position, k, *neighbor_kernels().back(), parallel);
}

PointArray<NeighborDistance> sample_neighbor_distances(const PointArray<Eigen::Vector3f>& position,
                                                       std::size_t k,
                                                       const Parallel& parallel)
{
  constexpr std::size_t wanted_leaves = 1024;
  constexpr std::size_t leaves_per_block = 64;
  const NeighborKernel& kernel = *neighbor_kernels().back();
  const BoxTree tree(position, kernel, parallel);
  const std::size_t step = std::max<std::size_t>(tree.leaf_count() / wanted_leaves, 1);
  using Distances = std::vector<NeighborDistance>;
  const auto search = [&](std::size_t begin, std::size_t end, Distances& distances) {
    GroupSearch group(tree, position, k, kernel);
    std::vector<std::uint32_t> rows(BoxTree::leaf_size * k);
    for (std::size_t leaf = begin * step; leaf < std::min(end * step, tree.leaf_count()); leaf += step) {
      group.search(leaf, leaf + 1, rows.data());
      const std::uint32_t* row = rows.data();
      for (std::size_t i = leaf * BoxTree::leaf_size; i < tree.leaf_end(leaf); ++i, row += k)
        distances.push_back({static_cast<std::uint32_t>(i), mean_distance(position, i, row, k)});
    }
  };
  const std::size_t leaves = (tree.leaf_count() + step - 1) / step;
  return joined(parallel_parts<Distances>(leaves, leaves_per_block, parallel, search), parallel);
}

}  // namespace pds
