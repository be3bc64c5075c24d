// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include <pcl_pds_recon/point_array.h>

namespace pds
{

/** \brief Points in cubic cells, for visits to all that are within a cell's side of some place. */
class PointGrid
{
 public:
  /** \param position places, all within a cube
   * \param points their numbers, ascending
   * \param side of a cell; 2^-19 of the cube's at least is used
   * \param low corner of the cube, \a extent its side: those of the positions of ordered points */
  template <typename Positions>
  PointGrid(const Positions& position,
            const std::vector<std::uint32_t>& points,
            double side,
            const Eigen::Vector3d& low = Eigen::Vector3d::Constant(-0.5),
            double extent = 1)
      : low_(low), cells_per_unit_(1 / std::max(side, std::ldexp(extent, 2 - axis_bits)))
  {
    entries_.reserve(points.size());
    for (const std::uint32_t p : points) {
      const Cell c = cell_of(position[p].template cast<double>());
      entries_.emplace_back(key_of(c.x, c.y, c.z), p);
    }
    std::sort(entries_.begin(), entries_.end());
  }

  /** \brief Calls visit(point) for all points in the cell of \a place and those around it, always in the same order. */
  template <typename Place, typename Visit>
  void visit_near(const Place& place, const Visit& visit) const
  {
    const Cell c = cell_of(place.template cast<double>());
    for (std::uint64_t x = c.x - 1; x <= c.x + 1; ++x)
      for (std::uint64_t y = c.y - 1; y <= c.y + 1; ++y) {
        const std::uint64_t last = key_of(x, y, c.z + 1);
        auto entry = std::lower_bound(entries_.begin(), entries_.end(), Entry(key_of(x, y, c.z - 1), 0));
        for (; entry != entries_.end() && entry->first <= last; ++entry) visit(entry->second);
      }
  }

 private:
  using Entry = std::pair<std::uint64_t, std::uint32_t>;  // cell and point
  struct Cell
  {
    std::uint64_t x, y, z;
  };
  static constexpr int axis_bits = 21;

  static std::uint64_t key_of(std::uint64_t x, std::uint64_t y, std::uint64_t z)
  {
    return (x << axis_bits | y) << axis_bits | z;
  }
  /** \brief From 1 on, so that there is a cell before each. */
  [[nodiscard]] Cell cell_of(const Eigen::Vector3d& p) const
  {
    const auto along = [&](int axis) {
      return static_cast<std::uint64_t>(std::max((p[axis] - low_[axis]) * cells_per_unit_, 0.0)) + 1;
    };
    return {along(0), along(1), along(2)};
  }

  Eigen::Vector3d low_;
  double cells_per_unit_;
  std::vector<Entry> entries_;
};

}  // namespace pds
