// SPDX-License-Identifier: BSD-3-Clause
#include "thinnest_direction.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace pds
{
namespace
{

/** \brief cos(2/3 acos(t)) for t in 0 ... 1, to 1e-10.
 *
 * Interpolated at the Chebyshev nodes. The function is analytic there, unlike cos(1/3 acos(t)), so few terms do; and
 * additions and multiplications give the same bits everywhere, unlike the C library's cos and acos.
 */
double cosine_of_two_thirds(double t)
{
  constexpr double coefficients[] = {-0.000207596641055, 0.00140248908825, -0.00448529836202, 0.00937813545401,
                                     -0.0152799917807,   0.0223199112377,  -0.032813031821,   0.0534454429579,
                                     -0.111110309759,    0.5773502495,     0.500000000081};
  double value = 0;
  for (const double c : coefficients) value = value * t + c;
  return value;
}

/** \brief The smallest root of the characteristic polynomial, by Viete's trigonometric formula. */
double smallest_eigenvalue(const Eigen::Matrix3d& a)
{
  const double mean = a.trace() / 3;
  const Eigen::Vector3d d = a.diagonal().array() - mean;
  const double xy = a(0, 1) * a(0, 1);
  const double yz = a(1, 2) * a(1, 2);
  const double xz = a(0, 2) * a(0, 2);
  const double square = (d.squaredNorm() + 2 * (xy + yz + xz)) / 6;
  const double spread = std::sqrt(square);
  const double half_determinant =
      0.5 * (d.x() * (d.y() * d.z() - yz) - xy * d.z() - xz * d.y()) + a(0, 1) * a(1, 2) * a(0, 2);
  // The other two roots coincide at a cosine of -1, this one and the middle one at 1.
  const double cosine = square > 0 ? std::clamp(half_determinant / (square * spread), -1.0, 1.0) : 0.0;
  return std::max(0.0, mean - 2 * spread * cosine_of_two_thirds(std::sqrt(0.5 * (1 - cosine))));
}

}  // namespace

ThinnestDirection find_thinnest_direction(const Eigen::Matrix3d& covariance)
{
  const double variance = smallest_eigenvalue(covariance);
  Eigen::Matrix3d rest = covariance;
  rest.diagonal().array() -= variance;
  // Cross products of two rows are along the direction; that of the largest has suffered least from cancellation.
  const Eigen::Vector3d across[] = {rest.row(1).cross(rest.row(2)), rest.row(2).cross(rest.row(0)),
                                    rest.row(0).cross(rest.row(1))};
  // They are the rows of a symmetric matrix of rank one: the largest has the largest entry on the diagonal.
  int largest = std::abs(across[1].y()) > std::abs(across[0].x()) ? 1 : 0;
  if (std::abs(across[2].z()) > std::abs(across[largest][largest])) largest = 2;
  const double length = across[largest].norm();
  constexpr double half_precision = 1e-8;  // below it rounding turns the product out of its plane
  if (length > half_precision * rest.squaredNorm()) return {across[largest] / length, variance};
  // All on a line, or spread alike in all directions: any direction across the longest row.
  int longest = 0;
  for (int row = 1; row < 3; ++row)
    if (rest.row(row).squaredNorm() > rest.row(longest).squaredNorm()) longest = row;
  const Eigen::Vector3d line = rest.row(longest);
  return {line.squaredNorm() > 0 ? line.unitOrthogonal() : Eigen::Vector3d::UnitX(), variance};
}

}  // namespace pds
