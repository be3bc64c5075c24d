// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/nearest_neighbors.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include "neighbor_kernel.h"

namespace pds
{
namespace
{

constexpr std::size_t leaf_size = 8;  // points per leaf: one or two vector registers of distances

/** \brief Squared distance and index in one integer that sorts like the pair. */
using Candidate = std::uint64_t;

Candidate make_candidate(float squared_distance, std::uint32_t index)
{
  std::uint32_t bits;
  std::memcpy(&bits, &squared_distance, sizeof bits);
  return Candidate{bits} << 32 | index;
}

float squared_distance_of(Candidate candidate)
{
  const auto bits = static_cast<std::uint32_t>(candidate >> 32);
  float squared_distance;
  std::memcpy(&squared_distance, &bits, sizeof bits);
  return squared_distance;
}

/** \brief The k best candidates so far, ascending. */
class BestCandidates
{
 public:
  explicit BestCandidates(std::size_t k) : best_(k) {}

  void clear()
  {
    std::fill(best_.begin(), best_.end(), std::numeric_limits<Candidate>::max());
    worst_ = infinity;
  }
  [[nodiscard]] float worst() const { return worst_; }
  [[nodiscard]] const std::vector<Candidate>& sorted() const { return best_; }

  void insert(Candidate candidate)
  {
    if (candidate >= best_.back()) return;
    std::size_t place = best_.size() - 1;
    for (; place > 0 && best_[place - 1] > candidate; --place) best_[place] = best_[place - 1];
    best_[place] = candidate;
    if (best_.back() != std::numeric_limits<Candidate>::max()) worst_ = squared_distance_of(best_.back());
  }

 private:
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  std::vector<Candidate> best_;
  float worst_ = infinity;
};

struct Box
{
  Eigen::Vector3f low = Eigen::Vector3f::Constant(std::numeric_limits<float>::infinity());
  Eigen::Vector3f high = Eigen::Vector3f::Constant(-std::numeric_limits<float>::infinity());

  void extend(const Box& other)
  {
    low = low.cwiseMin(other.low);
    high = high.cwiseMax(other.high);
  }

  [[nodiscard]] float squared_distance(const Box& other) const
  {
    float sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float gap = std::max({low[axis] - other.high[axis], other.low[axis] - high[axis], 0.0F});
      sum += gap * gap;
    }
    return sum;
  }

  [[nodiscard]] float squared_distance(const Eigen::Vector3f& p) const
  {
    float sum = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const float outside = std::max({low[axis] - p[axis], p[axis] - high[axis], 0.0F});
      sum += outside * outside;
    }
    return sum;
  }
};

/** \brief Complete binary tree: node 1 is the root, 2i and 2i + 1 are the children of i, leaves come last. */
class BoxTree
{
 public:
  explicit BoxTree(const std::vector<Eigen::Vector3f>& position) : position_(position)
  {
    const std::size_t leaves = (position.size() + leaf_size - 1) / leaf_size;
    while (first_leaf_ < leaves) first_leaf_ *= 2;
    box_.resize(2 * first_leaf_);
    for (std::size_t i = 0; i < position.size(); ++i) {
      Box& leaf = box_[first_leaf_ + i / leaf_size];
      leaf.low = leaf.low.cwiseMin(position[i]);
      leaf.high = leaf.high.cwiseMax(position[i]);
    }
    for (std::size_t node = first_leaf_ - 1; node > 0; --node) {
      box_[node].extend(box_[2 * node]);
      box_[node].extend(box_[2 * node + 1]);
    }
  }

  void search(std::uint32_t query, BestCandidates& best) const
  {
    const Eigen::Vector3f q = position_[query];
    best.clear();
    struct Visit
    {
      std::size_t node;
      float squared_distance;
    };
    Visit stack[64];
    std::size_t depth = 0;
    // The query's own leaf first: it gives a tight bound at once.
    const std::size_t own_leaf = first_leaf_ + query / leaf_size;
    scan_leaf(own_leaf, q, query, best);
    stack[depth++] = {1, 0.0F};
    while (depth > 0) {
      const Visit visit = stack[--depth];
      if (visit.squared_distance > best.worst()) continue;
      if (visit.node >= first_leaf_) {
        if (visit.node != own_leaf) scan_leaf(visit.node, q, query, best);
        continue;
      }
      Visit near{2 * visit.node, box_[2 * visit.node].squared_distance(q)};
      Visit far{2 * visit.node + 1, box_[2 * visit.node + 1].squared_distance(q)};
      if (far.squared_distance < near.squared_distance) std::swap(near, far);
      if (far.squared_distance <= best.worst()) stack[depth++] = far;
      if (near.squared_distance <= best.worst()) stack[depth++] = near;
    }
  }

  [[nodiscard]] std::size_t leaf_count() const { return (position_.size() + leaf_size - 1) / leaf_size; }
  [[nodiscard]] const Box& leaf_box(std::size_t leaf) const { return box_[first_leaf_ + leaf]; }

  /** \brief Leaves within a distance of a box, ascending; false if they hold more than \a most_points. */
  bool gather_leaves(const Box& box,
                     float squared_reach,
                     std::size_t most_points,
                     std::vector<std::size_t>& leaves) const
  {
    leaves.clear();
    std::size_t stack[64];
    std::size_t depth = 0;
    stack[depth++] = 1;
    while (depth > 0) {
      const std::size_t node = stack[--depth];
      if (box_[node].squared_distance(box) > squared_reach) continue;
      if (node < first_leaf_) {
        stack[depth++] = 2 * node + 1;
        stack[depth++] = 2 * node;
      } else {
        leaves.push_back(node - first_leaf_);
        if (leaves.size() * leaf_size > most_points) return false;
      }
    }
    return true;
  }

 private:
  void scan_leaf(std::size_t node, const Eigen::Vector3f& q, std::uint32_t query, BestCandidates& best) const
  {
    const std::size_t begin = (node - first_leaf_) * leaf_size;
    const std::size_t end = std::min(begin + leaf_size, position_.size());
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3f d = position_[i] - q;
      const float squared_distance = d.x() * d.x() + d.y() * d.y() + d.z() * d.z();
      if (squared_distance <= best.worst() && i != query)
        best.insert(make_candidate(squared_distance, static_cast<std::uint32_t>(i)));
    }
  }

  const std::vector<Eigen::Vector3f>& position_;
  std::vector<Box> box_;
  std::size_t first_leaf_ = 1;
};

/** \brief Searches for all points of a leaf together: they share their candidates.
 *
 * All points within a guessed reach of the leaf are candidates. A query that finds k of them within the reach has found
 * its true neighbours, for every other point is farther away. The guess comes from the leaf before, which is close by;
 * what it fails for is searched point by point.
 */
class LeafSearch
{
 public:
  LeafSearch(const BoxTree& tree, const std::vector<Eigen::Vector3f>& position, std::size_t k)
      : tree_(tree),
        position_(position),
        k_(k),
        set_(best_instruction_set()),
        best_(k),
        most_candidates_(candidates_per_neighbor * (k + 1))
  {
    columns_.reserve(most_candidates_ + leaf_size);
  }

  /** \param rows receives k indices for every point of the leaf */
  void search(std::size_t leaf, std::uint32_t* rows)
  {
    const std::size_t begin = leaf * leaf_size;
    const std::size_t end = std::min(begin + leaf_size, position_.size());
    const float squared_reach = reach_ * reach_;
    const bool common =
        reach_ > 0 && tree_.gather_leaves(tree_.leaf_box(leaf), squared_reach, most_candidates_, leaves_);
    if (common) load_candidates();
    // The box distance and the point distances are rounded separately: what is this close to the reach counts as
    // beyond.
    constexpr float inside = 0.9999F;
    float farthest = 0;
    for (std::size_t i = begin; i < end; ++i) {
      const Eigen::Vector3f& q = position_[i];
      const NeighborQuery query{q.x(), q.y(), q.z(), static_cast<std::uint32_t>(i), inside * squared_reach};
      std::uint32_t* row = rows + (i - begin) * k_;
      float last = common ? select_nearest(set_, columns_, query, k_, scratch_, row) : infinity;
      if (last == infinity) last = search_alone(query.self, row);
      farthest = std::max(farthest, last);
    }
    reach_ = reach_growth * std::sqrt(farthest);
  }

 private:
  static constexpr float infinity = std::numeric_limits<float>::infinity();
  static constexpr std::size_t candidates_per_neighbor = 64;  // on a surface a leaf has about 10
  static constexpr float reach_growth = 1.15F;  // on random points: few failures, few superfluous candidates

  void load_candidates()
  {
    std::size_t count = 0;
    for (const std::size_t leaf : leaves_) {
      const std::size_t end = std::min((leaf + 1) * leaf_size, position_.size());
      for (std::size_t i = leaf * leaf_size; i < end; ++i, ++count) {
        columns_.x[count] = position_[i].x();
        columns_.y[count] = position_[i].y();
        columns_.z[count] = position_[i].z();
        columns_.index[count] = static_cast<std::uint32_t>(i);
      }
    }
    columns_.count = count;
  }

  /** \return the squared distance of the k-th neighbour */
  float search_alone(std::uint32_t i, std::uint32_t* row)
  {
    tree_.search(i, best_);
    for (std::size_t j = 0; j < k_; ++j) row[j] = static_cast<std::uint32_t>(best_.sorted()[j] & 0xffffffffU);
    return best_.worst();
  }

  const BoxTree& tree_;
  const std::vector<Eigen::Vector3f>& position_;
  std::size_t k_;
  InstructionSet set_;
  BestCandidates best_;
  std::size_t most_candidates_;
  float reach_ = 0;  ///< guess for the next leaf; 0 = none
  std::vector<std::size_t> leaves_;
  CandidateColumns columns_;
  SelectionScratch scratch_;
};

}  // namespace

std::vector<std::uint32_t> nearest_neighbors(const std::vector<Eigen::Vector3f>& position,
                                             std::size_t k,
                                             const Parallel& parallel)
{
  const BoxTree tree(position);
  std::vector<std::uint32_t> neighbors(position.size() * k);
  constexpr std::size_t leaves_per_block = 128;
  parallel.blocks(tree.leaf_count(), leaves_per_block, [&](std::size_t begin, std::size_t end, unsigned) {
    LeafSearch search(tree, position, k);
    for (std::size_t leaf = begin; leaf < end; ++leaf) search.search(leaf, neighbors.data() + leaf * leaf_size * k);
  });
  return neighbors;
}

}  // namespace pds
