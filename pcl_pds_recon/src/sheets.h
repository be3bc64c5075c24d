// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <pcl_pds_recon/neighbor_graph.h>

namespace pds
{

/** \brief That a point has a second sheet beside its own: what is on the other side of a plane between them. */
struct Sheet
{
  std::uint32_t point;             ///< whose sheet
  Eigen::Vector3f normal;          ///< unit, towards the own sheet
  float middle;                    ///< height of the plane, midway between the sheets, over the point: negative
  float half_gap;                  ///< between the sheets
  float clear;                     ///< between the sheets: so near to the plane there are no points but for ...
  std::ptrdiff_t strays;           ///< ... so many around a point, which noise brings there
  std::vector<std::uint32_t> row;  ///< nearest points of the own sheet, nearest first; empty: those there are
};

/** \brief The points that have a second sheet beside theirs. */
class Sheets
{
 public:
  Sheets(const OrderedPoints& points, const NeighborGraph& graph);

  [[nodiscard]] const std::vector<Sheet>& all() const { return sheets_; }
  /** \brief A point's sheet, or none. */
  [[nodiscard]] const Sheet* of(std::uint32_t point) const;
  void add(Sheet sheet);

  /** \brief Adds the neighbours of points that have a second sheet, if they lie on one of the two, see points of the
   * other, and none in between but strays: chance hides a gap from single points. */
  void spread();

  /** \brief True if a point and some of its neighbours are on different sides of the plane between the sheets. */
  [[nodiscard]] bool reaches_across(const Sheet& sheet, std::uint32_t point) const;

  /** \brief True if a point or one of its neighbours has a second sheet. */
  [[nodiscard]] bool are_near(std::uint32_t point) const;
  /** \brief A point's neighbours that are on its own sheet, nearest first. */
  [[nodiscard]] std::vector<std::uint32_t> own_row(std::uint32_t point) const;

 private:
  static constexpr std::uint32_t none = 0xffffffffU;

  /** \brief A point to which a sheet may spread. */
  struct Offer
  {
    std::uint32_t point;
    float squared_distance;
    std::uint32_t sheet;
  };

  [[nodiscard]] float height(const Sheet& sheet, std::uint32_t point) const;
  [[nodiscard]] bool excludes(std::uint32_t point, std::uint32_t other) const;
  void adopt(const Offer& offer);
  [[nodiscard]] bool is_surrounded(std::uint32_t point) const;

  const OrderedPoints& points_;
  const NeighborGraph& graph_;
  std::vector<Sheet> sheets_;
  PointArray<std::uint32_t> of_point_;
  PointArray<std::uint8_t> has_sheet_;  ///< by point; looked up in a quarter of the memory
};

}  // namespace pds
