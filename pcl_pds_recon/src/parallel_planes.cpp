// SPDX-License-Identifier: BSD-3-Clause
#include "parallel_planes.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace pds
{

void ParallelPlanes::fit(const std::vector<Eigen::Vector3f>& points, const Eigen::Vector3f& normal, float middle)
{
  constexpr int rounds = 4;  // sides hardly change after the second
  normal_ = normal;
  side_.assign(points.size(), 0);
  for (int round = 0; round < rounds && split(points, round == 0 ? middle : this->middle()); ++round) find_axes(points);
}

float ParallelPlanes::blur() const
{
  return gap() > 0 ? std::sqrt(variance_[0]) / gap() : std::numeric_limits<float>::infinity();
}

bool ParallelPlanes::overlap() const
{
  // The means of two halves of a disk, parted by a step, are 1.7 of its standard deviations apart.
  constexpr float beside = 1.4F;
  const Eigen::Vector3f between = mean_[1] - mean_[0];
  const float shift2 = between.squaredNorm() - gap() * gap();
  return shift2 < beside * beside * 0.5F * (variance_[1] + variance_[2]);
}

bool ParallelPlanes::spread_both(const std::vector<Eigen::Vector3f>& points) const
{
  constexpr float strip = 1.0F / 9;  // the lesser variance over the greater if it is three times as long as wide
  std::array<Eigen::Matrix3f, 2> sum{Eigen::Matrix3f::Zero(), Eigen::Matrix3f::Zero()};
  for (std::size_t p = 0; p < points.size(); ++p) {
    Eigen::Vector3f d = points[p] - mean_[side_[p]];
    d -= normal_ * normal_.dot(d);
    sum[side_[p]] += d * d.transpose();
  }
  return std::all_of(sum.begin(), sum.end(), [](const Eigen::Matrix3f& m) {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
    solver.computeDirect(m, Eigen::EigenvaluesOnly);
    return solver.eigenvalues()[1] > strip * solver.eigenvalues()[2];
  });
}

/** \return true if the sides are others than before */
bool ParallelPlanes::split(const std::vector<Eigen::Vector3f>& points, float middle)
{
  bool changed = false;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const std::uint8_t side = normal_.dot(points[p]) > middle ? 1 : 0;
    changed = changed || side != side_[p];
    side_[p] = side;
  }
  return changed;
}

/** \brief Finds the principal axes of the points about the means of their sides. */
void ParallelPlanes::find_axes(const std::vector<Eigen::Vector3f>& points)
{
  mean_ = {Eigen::Vector3f::Zero(), Eigen::Vector3f::Zero()};
  count_ = {0, 0};
  for (std::size_t p = 0; p < points.size(); ++p) {
    mean_[side_[p]] += points[p];
    ++count_[side_[p]];
  }
  for (std::size_t s = 0; s < 2; ++s) mean_[s] /= static_cast<float>(std::max<std::size_t>(count_[s], 1));
  float xx = 0, yy = 0, zz = 0, xy = 0, yz = 0, zx = 0;
  for (std::size_t p = 0; p < points.size(); ++p) {
    const Eigen::Vector3f d = points[p] - mean_[side_[p]];
    xx += d.x() * d.x();
    yy += d.y() * d.y();
    zz += d.z() * d.z();
    xy += d.x() * d.y();
    yz += d.y() * d.z();
    zx += d.z() * d.x();
  }
  Eigen::Matrix3f sum;
  sum << xx, xy, zx, xy, yy, yz, zx, yz, zz;
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3f> solver;
  solver.computeDirect(sum / static_cast<float>(points.size()));
  variance_ = solver.eigenvalues().cwiseMax(0.0F);
  normal_ = solver.eigenvectors().col(0);
  if (normal_.dot(mean_[0]) > normal_.dot(mean_[1])) normal_ = -normal_;
  height_ = {normal_.dot(mean_[0]), normal_.dot(mean_[1])};
}

}  // namespace pds
