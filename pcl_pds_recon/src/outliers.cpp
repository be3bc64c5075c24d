// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/outliers.h>

#include <algorithm>
#include <vector>
#include "spread.h"

namespace pds
{
namespace
{

constexpr std::size_t block = 4096;  // points per block
constexpr double worth_while_share =
    1e-4;                             // of the points; fewer far ones do less harm than another neighbour search costs
constexpr float off_plane = 0.1F;     // a point so much of its reach off the plane of its neighbours, ...
constexpr float lone_height = 3.0F;   // ... and so many times as much as each of them, but one, off theirs
constexpr float far_from_all = 4.0F;  // or a reach so many times the median of all points ...
constexpr double shapeless = 0.25;    // ... in a neighbourhood this thick; an isotropic cloud has 0.58

constexpr float square(float x) { return x * x; }

/** \brief Tells outliers. */
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

  /** \brief Squared distance of a point from the plane of its neighbours. */
  [[nodiscard]] float squared_height(std::size_t i) const
  {
    const NeighborSpan row = graph_.nearest(i);
    if (row.size() == 0) return 0;  // a caller's search may find none
    SpreadSum sum(Spread{points_.position[*row.begin()]});
    for (const std::uint32_t* j = row.begin() + 1; j != row.end(); ++j) sum.add(Spread{points_.position[*j]});
    const Eigen::Vector3f& p = points_.position[i];
    return (sum.mean().plane().project(p) - p).squaredNorm();
  }

  /** \brief Off the surface by as little as a sharp corner may be, but alone: a crease goes on to other points. */
  [[nodiscard]] bool is_near(std::size_t i, const PointArray<float>& squared_height) const
  {
    const float height2 = squared_height[i];
    if (height2 <= square(off_plane) * graph_.reach[i].squared) return false;
    std::size_t as_high = 0;
    for (const std::uint32_t j : graph_.nearest(i))
      as_high += squared_height[j] * square(lone_height) > height2 ? 1 : 0;
    return as_high <= 1;  // which may be another outlier
  }

 private:
  const OrderedPoints& points_;
  const NeighborGraph& graph_;
  float far2_;
};

}  // namespace

std::vector<std::uint8_t> find_outliers(const OrderedPoints& points,
                                        const NeighborGraph& graph,
                                        const Parallel& parallel)
{
  if (points.size() < 2) return {};
  const OutlierRule rule(points, graph, square(far_from_all) * typical_squared_reach(graph.reach));
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
  PointArray<float> squared_height(points.size());
  parallel.each(points.size(), block, [&](std::size_t i) { squared_height[i] = rule.squared_height(i); });
  parallel.each(points.size(), block, [&](std::size_t i) {
    if (outlier[i] == 0) outlier[i] = rule.is_near(i, squared_height) ? 1 : 0;
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
