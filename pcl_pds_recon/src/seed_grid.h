// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <vector>

#include "point_grid.h"

namespace pds
{

/** \brief Seeds, for visits to all that are near some place. */
class SeedGrid
{
 public:
  /** \param seeds ascending
   * \param longest_reach of any visit, radii */
  SeedGrid(const std::vector<Eigen::Vector3d>& position, const std::vector<std::uint32_t>& seeds, double longest_reach)
      : position_(position), box_(box_of(position)), grid_(position, seeds, longest_reach, box_.min(), extent(box_))
  {
  }

  /** \brief Calls visit() for all of the seeds nearer to \a place than \a reach. */
  template <typename Visit>
  void visit_near(const Eigen::Vector3d& place, double reach, const Visit& visit) const
  {
    grid_.visit_near(place, [&](std::uint32_t seed) {
      if ((position_[seed] - place).squaredNorm() < reach * reach) visit(seed);
    });
  }

 private:
  static Eigen::AlignedBox3d box_of(const std::vector<Eigen::Vector3d>& position)
  {
    Eigen::AlignedBox3d box(Eigen::Vector3d::Zero());
    for (const Eigen::Vector3d& p : position) box.extend(p);
    return box;
  }
  static double extent(const Eigen::AlignedBox3d& box) { return box.sizes().maxCoeff(); }

  const std::vector<Eigen::Vector3d>& position_;
  Eigen::AlignedBox3d box_;
  PointGrid grid_;
};

}  // namespace pds
