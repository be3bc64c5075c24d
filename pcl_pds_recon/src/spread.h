// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include <pcl_pds_recon/neighbor_graph.h>

namespace pds
{

/** \brief The plane in which points lie best. */
struct FittedPlane
{
  Eigen::Vector3f middle;
  Eigen::Vector3f normal;
  double thickness;  ///< square root of the share of the points' spread that is along the normal, 0 ... 0.58

  [[nodiscard]] Eigen::Vector3f project(const Eigen::Vector3f& p) const { return p - normal * normal.dot(p - middle); }
};

/** \brief Mean and covariance of points, which are kept relative to the mean so that nothing cancels. */
struct Spread
{
  Eigen::Vector3f mean;
  float xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;

  [[nodiscard]] FittedPlane plane() const
  {
    Eigen::Matrix3d covariance;
    covariance << xx, xy, zx, xy, yy, yz, zx, yz, zz;
    const double trace = covariance.trace();
    if (trace > 0) covariance /= trace;
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
    solver.computeDirect(covariance);
    return {mean, solver.eigenvectors().col(0).cast<float>(), std::sqrt(std::max(solver.eigenvalues()[0], 0.0))};
  }
};

/** \brief Adds up neighbourhoods, each of which weighs the same. */
class SpreadSum
{
 public:
  explicit SpreadSum(const Spread& first) : origin_(first.mean) { add(first); }

  void add(const Spread& s)
  {
    const Eigen::Vector3f d = s.mean - origin_;
    sum_.mean += d;
    sum_.xx += s.xx + d.x() * d.x();
    sum_.yy += s.yy + d.y() * d.y();
    sum_.zz += s.zz + d.z() * d.z();
    sum_.xy += s.xy + d.x() * d.y();
    sum_.yz += s.yz + d.y() * d.z();
    sum_.zx += s.zx + d.z() * d.x();
    count_ += 1;
  }

  [[nodiscard]] Spread mean() const
  {
    const float share = 1 / count_;
    const Eigen::Vector3f d = sum_.mean * share;
    return {origin_ + d,
            sum_.xx * share - d.x() * d.x(),
            sum_.yy * share - d.y() * d.y(),
            sum_.zz * share - d.z() * d.z(),
            sum_.xy * share - d.x() * d.y(),
            sum_.yz * share - d.y() * d.z(),
            sum_.zx * share - d.z() * d.x()};
  }

 private:
  Eigen::Vector3f origin_;
  Spread sum_{Eigen::Vector3f::Zero()};
  float count_ = 0;
};

/** \brief Of a point and its own nearest neighbours. */
inline Spread spread_around(const OrderedPoints& points, const NeighborGraph& graph, std::size_t i)
{
  SpreadSum sum(Spread{points.position[i]});
  for (const std::uint32_t j : graph.nearest(i)) sum.add(Spread{points.position[j]});
  return sum.mean();
}

}  // namespace pds
