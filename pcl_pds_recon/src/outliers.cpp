// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/outliers.h>

#include <algorithm>
#include "spread.h"

namespace pds
{
namespace
{

constexpr std::size_t block = 4096;  // points per block
constexpr double worth_while_share =
    1e-4;                             // of the points; fewer far ones do less harm than another neighbour search costs
constexpr std::size_t few = 3;        // neighbours of an outlier, of which one at least is none
constexpr float apart = 1.1F;         // a reach so many times that of the neighbours, and ...
constexpr float off_plane = 0.45F;    // ... so much of it off their plane: half of their reach above it
constexpr float far_from_all = 4.0F;  // or a reach so many times the median of all points ...
constexpr double shapeless = 0.25;    // ... in a neighbourhood this thick; an isotropic cloud has 0.58

constexpr float square(float x) { return x * x; }

/** \brief The median of every 16th point's: enough to tell orders of magnitude. */
float typical(const PointArray<Reach>& reach)
{
  constexpr std::size_t stride = 16;
  std::vector<float> sample;
  for (std::size_t i = 0; i < reach.size(); i += stride) sample.push_back(reach[i].squared);
  const auto middle = sample.begin() + static_cast<std::ptrdiff_t>(sample.size() / 2);
  std::nth_element(sample.begin(), middle, sample.end());
  return *middle;
}

/** \brief Tells outliers. Holds the working memory of one thread. */
class OutlierRule
{
 public:
  /** \param far2 squared reach that only strays and coarser surfaces have */
  OutlierRule(const OrderedPoints& points, const NeighborGraph& graph, float far2)
      : points_(points), graph_(graph), far2_(far2)
  {
  }

  [[nodiscard]] bool is_far(std::size_t i) const
  {
    if (is_shapeless(i)) return true;
    const NeighborSpan row = graph_.nearest(i);
    const float lone2 = graph_.reach[i].squared / square(lone_reach);
    std::size_t outreached = 0;
    for (const std::uint32_t j : row) outreached += graph_.reach[j].squared < lone2 ? 1 : 0;
    return outreached > row.size() / 2;
  }

  /** \brief Far from all others, and from anything like a surface. */
  [[nodiscard]] bool is_shapeless(std::size_t i) const
  {
    return graph_.reach[i].squared > far2_ && spread_around(points_, graph_, i).plane().thickness > shapeless;
  }

  /** \brief Off the surface by as little as noise or a sharp corner may be. */
  bool is_near(std::size_t i)
  {
    const NeighborSpan row = graph_.nearest(i);
    const float reach2 = graph_.reach[i].squared;
    const float apart2 = reach2 / square(apart);
    // The nearest neighbours alone tell of most points that they are none.
    const std::uint32_t* const few_end = row.begin() + std::min<std::size_t>(few, row.size());
    return (reach2 > far2_ ||
            std::any_of(row.begin(), few_end, [&](std::uint32_t j) { return apart2 > graph_.reach[j].squared; })) &&
           apart2 > reach2_around(row) && squared_distance_from_plane(i, row) > square(off_plane) * reach2;
  }

 private:
  /** \brief Median of the neighbours' squared reaches. */
  float reach2_around(const NeighborSpan& row)
  {
    scratch_.clear();
    for (const std::uint32_t j : row) scratch_.push_back(graph_.reach[j].squared);
    const auto middle = scratch_.begin() + static_cast<std::ptrdiff_t>(scratch_.size() / 2);
    std::nth_element(scratch_.begin(), middle, scratch_.end());
    return *middle;
  }

  /** \brief Of a point from the plane of its neighbours. */
  [[nodiscard]] float squared_distance_from_plane(std::size_t i, const NeighborSpan& row) const
  {
    SpreadSum sum(Spread{points_.position[*row.begin()]});
    for (const std::uint32_t* j = row.begin() + 1; j != row.end(); ++j) sum.add(Spread{points_.position[*j]});
    const Eigen::Vector3f& p = points_.position[i];
    return (sum.mean().plane().project(p) - p).squaredNorm();
  }

  const OrderedPoints& points_;
  const NeighborGraph& graph_;
  float far2_;
  std::vector<float> scratch_;
};

}  // namespace

std::vector<std::uint8_t> find_outliers(const OrderedPoints& points,
                                        const NeighborGraph& graph,
                                        const Parallel& parallel)
{
  if (points.size() < 2) return {};
  const OutlierRule rule(points, graph, square(far_from_all) * typical(graph.reach));
  const auto worth_while = [&](std::size_t outliers) {
    return static_cast<double>(outliers) > worth_while_share * static_cast<double>(points.size());
  };
  // Lone points have been counted by the way. Most clouds need no closer look.
  const std::size_t shapeless_points = parallel.sum(points.size(), block, [&](std::size_t begin, std::size_t end) {
    std::size_t part = 0;
    for (std::size_t i = begin; i < end; ++i) part += rule.is_shapeless(i) ? 1 : 0;
    return part;
  });
  if (!worth_while(graph.lone_points + shapeless_points)) return {};
  std::vector<std::uint8_t> outlier(points.size());
  const std::size_t far = parallel.sum(points.size(), block, [&](std::size_t begin, std::size_t end) {
    std::size_t part = 0;
    for (std::size_t i = begin; i < end; ++i) part += outlier[i] = rule.is_far(i) ? 1 : 0;
    return part;
  });
  if (!worth_while(far)) return {};
  parallel.blocks(points.size(), block, [&](std::size_t begin, std::size_t end, unsigned) {
    OutlierRule own_rule = rule;  // with working memory of its own
    for (std::size_t i = begin; i < end; ++i)
      if (outlier[i] == 0) outlier[i] = own_rule.is_near(i) ? 1 : 0;
  });
  return outlier;
}

OrderedPoints without_outliers(OrderedPoints points, const std::vector<std::uint8_t>& outlier, const Parallel& parallel)
{
  std::vector<std::uint32_t> new_rank(points.size(), no_rank);
  std::uint32_t left = 0;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    if (outlier[i] != 0) continue;
    points.position[left] = points.position[i];
    points.input_index[left] = points.input_index[i];
    new_rank[i] = left++;
  }
  points.outliers += points.size() - left;
  points.position.resize(left);
  points.input_index.resize(left);
  parallel.each(points.rank_of_input.size(), block, [&](std::size_t i) {
    std::uint32_t& rank = points.rank_of_input[i];
    if (rank != no_rank) rank = new_rank[rank];
  });
  return points;
}

}  // namespace pds
