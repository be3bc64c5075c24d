// SPDX-License-Identifier: BSD-3-Clause
#include "compare/closest_point.h"

namespace pds
{

ClosestOnTriangle closest_on_triangle(const Eigen::Vector3d& p,
                                      const Eigen::Vector3d& a,
                                      const Eigen::Vector3d& b,
                                      const Eigen::Vector3d& c)
{
  const Eigen::Vector3d ab = b - a;
  const Eigen::Vector3d ac = c - a;
  const double ab_a = ab.dot(p - a);
  const double ac_a = ac.dot(p - a);
  if (ab_a <= 0 && ac_a <= 0) return {a, TrianglePart::corner_0};
  const double ab_b = ab.dot(p - b);
  const double ac_b = ac.dot(p - b);
  if (ab_b >= 0 && ac_b <= ab_b) return {b, TrianglePart::corner_1};
  const double weight_c = ab_a * ac_b - ab_b * ac_a;  // of the barycentric coordinates, not normalised
  if (weight_c <= 0 && ab_a >= 0 && ab_b <= 0) return {a + ab * (ab_a / (ab_a - ab_b)), TrianglePart::edge_01};
  const double ab_c = ab.dot(p - c);
  const double ac_c = ac.dot(p - c);
  if (ac_c >= 0 && ab_c <= ac_c) return {c, TrianglePart::corner_2};
  const double weight_b = ab_c * ac_a - ab_a * ac_c;
  if (weight_b <= 0 && ac_a >= 0 && ac_c <= 0) return {a + ac * (ac_a / (ac_a - ac_c)), TrianglePart::edge_20};
  const double weight_a = ab_b * ac_c - ab_c * ac_b;
  const double from_b = ac_b - ab_b;
  const double from_c = ab_c - ac_c;
  if (weight_a <= 0 && from_b >= 0 && from_c >= 0)
    return {b + (c - b) * (from_b / (from_b + from_c)), TrianglePart::edge_12};
  const double sum = weight_a + weight_b + weight_c;
  return {a + ab * (weight_b / sum) + ac * (weight_c / sum), TrianglePart::inside};
}

}  // namespace pds
