// SPDX-License-Identifier: BSD-3-Clause
#include "implicit_shape.h"

#include <algorithm>
#include <cmath>

namespace pds
{
namespace
{

using Eigen::Vector3d;

double sphere(const Vector3d& p, const Vector3d& center, double radius) { return (p - center).norm() - radius; }

/** \brief |p / radii| - 1 grows at most by 1 / min(radii) per unit, hence the factor. */
double ellipsoid(const Vector3d& p, const Vector3d& center, const Vector3d& radii)
{
  return ((p - center).cwiseQuotient(radii).norm() - 1.0) * radii.minCoeff();
}

/** \brief A segment thickened by a radius that changes linearly from a to b. */
double tapered_capsule(const Vector3d& p, const Vector3d& a, const Vector3d& b, double radius_a, double radius_b)
{
  const Vector3d axis = b - a;
  const double t = std::clamp((p - a).dot(axis) / axis.squaredNorm(), 0.0, 1.0);
  const double slope = (radius_b - radius_a) / axis.norm();
  return ((p - a - t * axis).norm() - (radius_a + t * (radius_b - radius_a))) / std::sqrt(1.0 + slope * slope);
}

/** \brief Union whose crease is rounded over a band of the given width; it keeps a slope of at most 1. */
double smooth_union(double a, double b, double width)
{
  const double overlap = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - overlap * overlap * width * 0.25;
}

/** \brief A box around the origin with edges parallel to the axes. */
double box(const Vector3d& p, const Vector3d& half_size)
{
  const Vector3d beyond = p.cwiseAbs() - half_size;
  return beyond.cwiseMax(0.0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

/** \brief An endless cylinder along z. */
double cylinder(const Vector3d& p, double x, double y, double radius)
{
  return (p - Vector3d(x, y, p.z())).norm() - radius;
}

}  // namespace

double duck_distance_bound(const Vector3d& point)
{
  // The two sides are mirror images.
  const Vector3d p(point.x(), std::abs(point.y()), point.z());

  const double body = ellipsoid(p, {-0.10, 0.0, -0.30}, {0.80, 0.58, 0.48});
  const double tail = tapered_capsule(p, {-0.60, 0.0, -0.15}, {-1.00, 0.0, 0.22}, 0.28, 0.06);
  const double wing = ellipsoid(p, {-0.18, 0.53, -0.18}, {0.42, 0.14, 0.24});
  const double wing_tip = tapered_capsule(p, {-0.30, 0.58, -0.16}, {-0.66, 0.66, 0.00}, 0.13, 0.045);
  const double head = sphere(p, {0.40, 0.0, 0.48}, 0.42);
  const double upper_bill = ellipsoid(p, {0.84, 0.0, 0.44}, {0.24, 0.21, 0.065});
  const double lower_bill = ellipsoid(p, {0.80, 0.0, 0.33}, {0.19, 0.16, 0.055});
  const double eye = sphere(p, {0.68, 0.20, 0.62}, 0.095);
  const double tuft = tapered_capsule(p, {0.36, 0.0, 0.85}, {0.20, 0.0, 1.02}, 0.09, 0.035);

  double shape = smooth_union(body, tail, 0.25);
  shape = smooth_union(shape, smooth_union(wing, wing_tip, 0.10), 0.06);
  shape = smooth_union(shape, head, 0.22);
  shape = smooth_union(shape, upper_bill, 0.08);
  shape = smooth_union(shape, lower_bill, 0.06);
  shape = smooth_union(shape, tuft, 0.08);
  return smooth_union(shape, eye, 0.03);
}

double part_distance_bound(const Vector3d& point)
{
  // Each quarter is like the others.
  const Vector3d p(std::abs(point.x()), std::abs(point.y()), point.z() + 0.3);

  const double plate = box(p, {1.0, 0.6, 0.1});
  const double boss = std::max(cylinder(p, 0.0, 0.0, 0.42), std::abs(p.z() - 0.3) - 0.4);
  // Below the slope from the top of the boss down to the plate.
  const double slope = (p - Vector3d(0.9, 0.0, 0.1)).dot(Vector3d(0.5, 0.0, 0.5)) / std::sqrt(0.5);
  const double rib = std::max(box(p - Vector3d(0.45, 0.0, 0.3), {0.45, 0.06, 0.4}), slope);
  const double bore = cylinder(p, 0.0, 0.0, 0.26);
  const double bolt_hole = cylinder(p, 0.8, 0.42, 0.09);

  return std::max(std::min({plate, boss, rib}), -std::min(bore, bolt_hole));
}

}  // namespace pds
