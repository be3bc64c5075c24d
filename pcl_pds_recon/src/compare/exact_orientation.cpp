// SPDX-License-Identifier: BSD-3-Clause
#include "compare/exact_orientation.h"

// GCC 12 believes that numbers of Boost's may be without a value.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include <array>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <limits>

namespace pds
{
namespace
{

using Rational = boost::multiprecision::cpp_rational;

// Bounds of the rounding error, as shares of the sum of absolute products (Shewchuk 1997, "Adaptive precision
// floating-point arithmetic and fast robust geometric predicates", errboundA); epsilon is half of C++'s.
constexpr double epsilon = std::numeric_limits<double>::epsilon() / 2;
constexpr double bound_3d = (7 + 56 * epsilon) * epsilon;
constexpr double bound_2d = (3 + 16 * epsilon) * epsilon;

template <typename Number>
int sign(const Number& value)
{
  return value > 0 ? 1 : value < 0 ? -1 : 0;
}

int exact_sign(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d)
{
  const auto difference = [&a](const Eigen::Vector3d& p) {
    return std::array<Rational, 3>{Rational(p.x()) - Rational(a.x()), Rational(p.y()) - Rational(a.y()),
                                   Rational(p.z()) - Rational(a.z())};
  };
  const auto u = difference(b);
  const auto v = difference(c);
  const auto w = difference(d);
  const Rational volume =
      (u[1] * v[2] - u[2] * v[1]) * w[0] + (u[2] * v[0] - u[0] * v[2]) * w[1] + (u[0] * v[1] - u[1] * v[0]) * w[2];
  return sign(volume);
}

int exact_sign(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
  const Rational ax(a.x());
  const Rational ay(a.y());
  const Rational area =
      (Rational(b.x()) - ax) * (Rational(c.y()) - ay) - (Rational(b.y()) - ay) * (Rational(c.x()) - ax);
  return sign(area);
}

}  // namespace

int orientation(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d)
{
  const Eigen::Vector3d u = b - a;
  const Eigen::Vector3d v = c - a;
  const Eigen::Vector3d w = d - a;
  const double yz = u.y() * v.z();
  const double zy = u.z() * v.y();
  const double zx = u.z() * v.x();
  const double xz = u.x() * v.z();
  const double xy = u.x() * v.y();
  const double yx = u.y() * v.x();
  const double volume = (yz - zy) * w.x() + (zx - xz) * w.y() + (xy - yx) * w.z();
  const double magnitude = (std::abs(yz) + std::abs(zy)) * std::abs(w.x()) +
                           (std::abs(zx) + std::abs(xz)) * std::abs(w.y()) +
                           (std::abs(xy) + std::abs(yx)) * std::abs(w.z());
  if (magnitude == 0 || std::abs(volume) > bound_3d * magnitude) return sign(volume);
  return exact_sign(a, b, c, d);
}

int orientation(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
  const double left = (b.x() - a.x()) * (c.y() - a.y());
  const double right = (b.y() - a.y()) * (c.x() - a.x());
  const double area = left - right;
  const double magnitude = std::abs(left) + std::abs(right);
  if (magnitude == 0 || std::abs(area) > bound_2d * magnitude) return sign(area);
  return exact_sign(a, b, c);
}

}  // namespace pds
