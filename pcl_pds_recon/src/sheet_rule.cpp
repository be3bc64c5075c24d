// SPDX-License-Identifier: BSD-3-Clause
#include "sheet_rule.h"

#include <algorithm>
#include <cmath>

namespace pds
{
namespace
{

// In reaches of the point, which are 1.2 to 1.5 sampling intervals of one sheet.
constexpr float narrowest_gap = 0.5F;    // sheets 0.6 intervals apart
constexpr float narrowest_layer = 0.2F;  // a first look, along a normal that may be tilted

// Deviation from the planes over the gap. Noise of 0.3 intervals on sheets 2 apart gives 0.15; a band of noise, cut in
// half, 0.29 if it is even, 0.38 if it is normal.
constexpr float widest_blur = 0.2F;

// If a few points of a wall are off planes that most points lie in, the deviation is greater than most points show.
constexpr float noise_factor = 2.5F;
constexpr float least_blur = 0.05F;
constexpr std::size_t fewest = 6;  // points of a sheet; with fewer, chance puts them into a strip: the edges of a cube

// Between the sheets there are no points but at a rim, where a third one joins them.
constexpr float widest_clear = 0.5F;         // half gaps
constexpr float clear_per_deviation = 6.0F;  // noise reaches three deviations far; those are measured in whole gaps
constexpr std::size_t stray_share = 25;      // one point in so many may be there; noise brings one in 700

}  // namespace

bool SheetRule::find(std::uint32_t point, Sheet& sheet)
{
  const float reach = std::sqrt(graph_.reach[point].squared);
  std::array<Layer, 2> layers{empty_layer(point, normal_nearby(point)), empty_layer(point, surface_.normal[point])};
  if (layers[1].width > layers[0].width) std::swap(layers[0], layers[1]);
  if (!(layers[0].width >= narrowest_layer * reach) || reach <= 0) return false;
  if (cloud_.normals && !faces_both_ways(point)) return false;
  collect(point, reach);
  if (!are_sheets(layers[0], reach) && !are_sheets(layers[1], reach)) return false;
  describe(point, reach, sheet);
  return true;
}

/** \brief The normal of the flattest neighbourhood nearby. */
Eigen::Vector3f SheetRule::normal_nearby(std::uint32_t point) const
{
  std::uint32_t flattest = point;
  for (const std::uint32_t j : graph_.nearest(point))
    if (surface_.curvature[j] < surface_.curvature[flattest]) flattest = j;
  return surface_.normal[flattest];
}

/** \brief True unless all normals tell that the neighbours are of one side. */
bool SheetRule::faces_both_ways(std::uint32_t point) const
{
  const Eigen::Vector3d own = cloud_.normals[points_.input_index[point]];
  const NeighborSpan row = graph_.nearest(point);
  return std::any_of(row.begin(), row.end(), [&](std::uint32_t j) {
    return !(own.dot(cloud_.normals[points_.input_index[j]]) > 0);  // also if one of them has none
  });
}

/** \brief The widest layer without points between some of the neighbours and the others. */
SheetRule::Layer SheetRule::empty_layer(std::uint32_t point, const Eigen::Vector3f& normal)
{
  height_.assign(1, 0.0F);
  const Eigen::Vector3f center = points_.position[point];
  for (const std::uint32_t j : graph_.nearest(point)) height_.push_back(normal.dot(points_.position[j] - center));
  std::sort(height_.begin(), height_.end());
  Layer widest{normal, 0, 0};
  for (std::size_t h = 1; h < height_.size(); ++h)
    if (const float width = height_[h] - height_[h - 1]; width > widest.width)
      widest = {normal, width, 0.5F * (height_[h] + height_[h - 1])};
  return widest;
}

/** \brief A point's neighbours and theirs. */
void SheetRule::collect(std::uint32_t point, float reach)
{
  rank_.clear();
  if (++round_ == 0) {
    seen_.fill({});
    round_ = 1;
  }
  add(point);
  for (const std::uint32_t j : graph_.nearest(point)) add(j);
  for (const std::uint32_t j : graph_.nearest(point))
    for (const std::uint32_t k : graph_.nearest(j)) add(k);
  around_.clear();
  for (const std::uint32_t j : rank_) around_.push_back((points_.position[j] - points_.position[point]) / reach);
}

/** \brief Adds a point to those around, once. Half of the slots stay free, so that a free one is soon found. */
void SheetRule::add(std::uint32_t rank)
{
  if (rank_.size() > seen_.size() / 2) return;
  constexpr std::uint32_t golden = 0x9e3779b1U;  // 2^32 over the golden ratio: spreads ranks that follow one another
  std::size_t slot = (rank * golden) >> (32 - slot_bits);
  for (; seen_[slot].round == round_; slot = (slot + 1) % seen_.size())
    if (seen_[slot].rank == rank) return;
  seen_[slot] = {round_, rank};
  rank_.push_back(rank);
}

bool SheetRule::are_sheets(const Layer& layer, float reach)
{
  if (!(layer.width >= narrowest_layer * reach)) return false;
  planes_.fit(around_, layer.normal, layer.middle / reach);
  if (!(planes_.gap() >= narrowest_gap && planes_.blur() <= widest_blur) || planes_.fewer() < fewest ||
      !planes_.overlap() || !planes_.spread_both(around_))
    return false;
  const float noise = noise_of_most();
  if (planes_.blur() > noise_factor * noise + least_blur) return false;
  clear_ = std::clamp(1 - clear_per_deviation * noise, 0.0F, widest_clear);
  const float clear = 0.5F * clear_ * planes_.gap();
  const auto strays = std::count_if(around_.begin(), around_.end(), [&](const Eigen::Vector3f& p) {
    return std::abs(planes_.normal().dot(p) - planes_.middle()) < clear;
  });
  return static_cast<std::size_t>(strays) * stray_share <= around_.size();
}

/** \brief Deviation from the planes over the gap, as the nearer half of the points shows it. */
float SheetRule::noise_of_most()
{
  constexpr float deviation_per_median = 1.48F;  // of a normal deviate
  height_.clear();
  for (const Eigen::Vector3f& p : around_)
    height_.push_back(std::abs(std::abs(planes_.normal().dot(p) - planes_.middle()) - 0.5F * planes_.gap()));
  const auto median = height_.begin() + static_cast<std::ptrdiff_t>(height_.size() / 2);
  std::nth_element(height_.begin(), median, height_.end());
  return deviation_per_median * *median / planes_.gap();
}

void SheetRule::describe(std::uint32_t point, float reach, Sheet& sheet)
{
  const bool upper = planes_.middle() < 0;  // the point is at the origin
  sheet.point = point;
  sheet.normal = upper ? planes_.normal() : Eigen::Vector3f(-planes_.normal());
  sheet.middle = -std::abs(planes_.middle()) * reach;
  sheet.half_gap = 0.5F * planes_.gap() * reach;
  sheet.clear = clear_ * sheet.half_gap;
  sheet.strays = clear_ < widest_clear ? 1 : 0;  // noise that reaches there brings one in 700 points; two are a wall
  nearest_.clear();
  for (std::size_t p = 0; p < rank_.size(); ++p) {
    const bool is_upper = planes_.normal().dot(around_[p]) > planes_.middle();
    if (is_upper == upper && rank_[p] != point) nearest_.emplace_back(around_[p].squaredNorm(), rank_[p]);
  }
  std::sort(nearest_.begin(), nearest_.end());
  if (nearest_.size() > graph_.stride) nearest_.resize(graph_.stride);
  sheet.row.clear();
  for (const auto& [squared_distance, rank] : nearest_) sheet.row.push_back(rank);
}

}  // namespace pds
