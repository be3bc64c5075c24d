// SPDX-License-Identifier: BSD-3-Clause
#include "compare/triangle_intersection.h"

#include "compare/exact_orientation.h"

#include <Eigen/Geometry>
#include <algorithm>

namespace pds
{
namespace
{

using Point = Eigen::Vector3d;
using FlatTriangle = std::array<Eigen::Vector2d, 3>;

/** \brief The axis along which the triangle looks largest: seen so, its plane loses nothing. */
int widest_axis(const TriangleCorners& t)
{
  const Point normal = (t[1] - t[0]).cross(t[2] - t[0]);
  int axis = 0;
  normal.cwiseAbs().maxCoeff(&axis);
  return axis;
}

Eigen::Vector2d flatten(const Point& p, int axis) { return {p[(axis + 1) % 3], p[(axis + 2) % 3]}; }

bool in_triangle(const Eigen::Vector2d& p, const FlatTriangle& t)
{
  const int a = orientation(t[0], t[1], p);
  const int b = orientation(t[1], t[2], p);
  const int c = orientation(t[2], t[0], p);
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

bool boxes_meet(const Eigen::Vector2d& p, const Eigen::Vector2d& q, const Eigen::Vector2d& a, const Eigen::Vector2d& b)
{
  return (p.cwiseMax(q).array() >= a.cwiseMin(b).array()).all() &&
         (a.cwiseMax(b).array() >= p.cwiseMin(q).array()).all();
}

bool segments_meet(const Eigen::Vector2d& p,
                   const Eigen::Vector2d& q,
                   const Eigen::Vector2d& a,
                   const Eigen::Vector2d& b)
{
  return boxes_meet(p, q, a, b) && orientation(p, q, a) * orientation(p, q, b) <= 0 &&
         orientation(a, b, p) * orientation(a, b, q) <= 0;
}

/** \brief Whether the segment (p, q) and the triangle meet where they are seen along its widest axis; if all lie in one
 * plane, whether they meet. */
bool shadows_meet(const Point& p, const Point& q, const TriangleCorners& t)
{
  const int axis = widest_axis(t);
  const FlatTriangle flat = {flatten(t[0], axis), flatten(t[1], axis), flatten(t[2], axis)};
  const Eigen::Vector2d from = flatten(p, axis);
  const Eigen::Vector2d to = flatten(q, axis);
  return in_triangle(from, flat) || segments_meet(from, to, flat[0], flat[1]) ||
         segments_meet(from, to, flat[1], flat[2]) || segments_meet(from, to, flat[2], flat[0]);
}

/** \brief Whether the segment (p, q) meets the triangle, touching included. */
bool segment_meets(const Point& p, const Point& q, const TriangleCorners& t)
{
  // First, because it spares the exact and slow comparison of neighbours that lie in one plane but for rounding.
  if (!shadows_meet(p, q, t)) return false;
  const int side_p = orientation(t[0], t[1], t[2], p);
  const int side_q = orientation(t[0], t[1], t[2], q);
  if (side_p == 0 && side_q == 0) return true;
  if (side_p * side_q > 0) return false;
  const int a = orientation(p, q, t[0], t[1]);
  const int b = orientation(p, q, t[1], t[2]);
  const int c = orientation(p, q, t[2], t[0]);
  return (a >= 0 && b >= 0 && c >= 0) || (a <= 0 && b <= 0 && c <= 0);
}

bool any_edge_meets(const TriangleCorners& s, const TriangleCorners& t)
{
  return segment_meets(s[0], s[1], t) || segment_meets(s[1], s[2], t) || segment_meets(s[2], s[0], t);
}

/** \brief Both triangles turned so that their common corners come first, in the same order. \return how many */
int bring_common_forward(TriangleCorners& s, TriangleCorners& t)
{
  int common = 0;
  for (int i = 0; i < 3; ++i) {
    const auto same = std::find(t.begin() + common, t.end(), s[static_cast<std::size_t>(i)]);
    if (same == t.end()) continue;
    std::swap(s[static_cast<std::size_t>(i)], s[static_cast<std::size_t>(common)]);
    std::swap(*same, t[static_cast<std::size_t>(common)]);
    ++common;
  }
  return common;
}

/** \brief Two triangles at the edge (s[0], s[1]): whether they lie on the same side of it in one plane. */
bool fold_flat(const TriangleCorners& s, const Point& apex)
{
  const int axis = widest_axis(s);
  const Eigen::Vector2d a = flatten(s[0], axis);
  const Eigen::Vector2d b = flatten(s[1], axis);
  const bool same_side = orientation(a, b, flatten(s[2], axis)) * orientation(a, b, flatten(apex, axis)) > 0;
  return same_side && orientation(s[0], s[1], s[2], apex) == 0;
}

}  // namespace

bool triangles_intersect(const TriangleCorners& first, const TriangleCorners& second)
{
  TriangleCorners s = first;
  TriangleCorners t = second;
  switch (bring_common_forward(s, t)) {
    case 0:
      return any_edge_meets(s, t) || any_edge_meets(t, s);
    case 1:
      // What they share beyond the corner goes on until it leaves one of them, across the edge opposite the corner.
      return segment_meets(s[1], s[2], t) || segment_meets(t[1], t[2], s);
    case 2:
      return fold_flat(s, t[2]);
    default:
      return true;
  }
}

}  // namespace pds
