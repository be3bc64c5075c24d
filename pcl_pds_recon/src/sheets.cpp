// SPDX-License-Identifier: BSD-3-Clause
#include "sheets.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace pds
{

Sheets::Sheets(const OrderedPoints& points, const NeighborGraph& graph)
    : points_(points), graph_(graph), of_point_(points.size(), none), has_sheet_(points.size(), std::uint8_t{0})
{
}

const Sheet* Sheets::of(std::uint32_t point) const
{
  return of_point_[point] == none ? nullptr : &sheets_[of_point_[point]];
}

void Sheets::add(Sheet sheet)
{
  has_sheet_[sheet.point] = 1;
  of_point_[sheet.point] = static_cast<std::uint32_t>(sheets_.size());
  sheets_.push_back(std::move(sheet));
}

void Sheets::spread()
{
  std::vector<Offer> offers;
  for (std::uint32_t s = 0; s < sheets_.size(); ++s)
    for (const std::uint32_t j : graph_.nearest(sheets_[s].point))
      if (has_sheet_[j] == 0)
        offers.push_back({j, (points_.position[j] - points_.position[sheets_[s].point]).squaredNorm(), s});
  std::sort(offers.begin(), offers.end(), [](const Offer& a, const Offer& b) {
    return std::tie(a.point, a.squared_distance, a.sheet) < std::tie(b.point, b.squared_distance, b.sheet);
  });
  for (const Offer& offer : offers)
    if (has_sheet_[offer.point] == 0) adopt(offer);
}

void Sheets::adopt(const Offer& offer)
{
  const Sheet& from = sheets_[offer.sheet];
  const float over = height(from, offer.point);
  Sheet sheet{offer.point,
              over > 0 ? from.normal : Eigen::Vector3f(-from.normal),
              -std::abs(over),
              from.half_gap,
              from.clear,
              from.strays,
              {}};
  const NeighborSpan row = graph_.nearest(offer.point);
  const auto is_across = [&](std::uint32_t j) { return height(sheet, j) < 0; };
  const auto is_between = [&](std::uint32_t j) { return std::abs(height(sheet, j)) < sheet.clear; };
  const bool is_off = std::abs(std::abs(over) - from.half_gap) > from.half_gap - from.clear;
  const auto strays = std::count_if(row.begin(), row.end(), is_between) + (is_off ? 1 : 0);
  if (strays <= (is_surrounded(offer.point) ? from.strays : 0) && std::any_of(row.begin(), row.end(), is_across))
    add(std::move(sheet));
}

/** \brief True if most of a point's neighbours have a second sheet: it is in the midst of them, and not at a rim. */
bool Sheets::is_surrounded(std::uint32_t point) const
{
  constexpr double most = 0.75;
  const NeighborSpan row = graph_.nearest(point);
  const auto parted = std::count_if(row.begin(), row.end(), [&](std::uint32_t j) { return has_sheet_[j] != 0; });
  return static_cast<double>(parted) > most * static_cast<double>(row.size());
}

bool Sheets::reaches_across(const Sheet& sheet, std::uint32_t point) const
{
  const bool side = height(sheet, point) < 0;
  const NeighborSpan row = graph_.nearest(point);
  return std::any_of(row.begin(), row.end(), [&](std::uint32_t j) { return (height(sheet, j) < 0) != side; });
}

bool Sheets::are_near(std::uint32_t point) const
{
  // Without branches, for hardly any point has one.
  unsigned count = has_sheet_[point];
  for (const std::uint32_t j : graph_.nearest(point)) count += has_sheet_[j];
  return count != 0;
}

std::vector<std::uint32_t> Sheets::own_row(std::uint32_t point) const
{
  const Sheet* const own = of(point);
  const NeighborSpan listed = graph_.nearest(point);
  std::vector<std::uint32_t> row(listed.begin(), listed.end());
  if (own != nullptr && !own->row.empty()) row = own->row;
  row.erase(std::remove_if(row.begin(), row.end(), [&](std::uint32_t j) { return excludes(point, j); }), row.end());
  // Noise may carry a point into the middle, where many of its neighbours put it on the other side. It has its way.
  const auto is_disowned_by = [&](std::uint32_t j) { return excludes(j, point); };
  const auto disowning = std::count_if(row.begin(), row.end(), is_disowned_by);
  if (2 * disowning <= row.end() - row.begin())
    row.erase(std::remove_if(row.begin(), row.end(), is_disowned_by), row.end());
  return row;
}

/** \brief Of a point over the plane between the sheets. */
float Sheets::height(const Sheet& sheet, std::uint32_t point) const
{
  return sheet.normal.dot(points_.position[point] - points_.position[sheet.point]) - sheet.middle;
}

bool Sheets::excludes(std::uint32_t point, std::uint32_t other) const
{
  const Sheet* const sheet = of(point);
  return sheet != nullptr && height(*sheet, other) < 0;
}

}  // namespace pds
