// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/triangle_complex.h>
#include <Eigen/Geometry>
#include <algorithm>

namespace pds
{

using Eigen::Vector3d;

double TriangleComplex::facing(const Triangle& t) const
{
  if (outward_.empty()) return 1;
  const Vector3d across = (position_[t[1]] - position_[t[0]]).cross(position_[t[2]] - position_[t[0]]).normalized();
  const double sign = across.dot(outward_[t[0]] + outward_[t[1]] + outward_[t[2]]) < 0 ? -1 : 1;
  double least = 1;
  for (const std::uint32_t v : t) least = std::min(least, sign * across.dot(outward_[v]));
  return least;
}

/** By the mean of the normals at the corners, by which a face that stands on a crease has a side as well. */
TriangleComplex::Side TriangleComplex::side_by_normals(const Triangle& t) const
{
  constexpr double behind = -0.5;  // cosine between face and a corner's normal: over 120 degrees is the other side
  if (facing(t) < behind) return Side::torn;
  const Vector3d across = (position_[t[1]] - position_[t[0]]).cross(position_[t[2]] - position_[t[0]]);
  const double cosine = across.dot(outward_[t[0]] + outward_[t[1]] + outward_[t[2]]);
  if (cosine == 0) return Side::unclear;
  return cosine > 0 ? Side::front : Side::back;
}

bool TriangleComplex::opposed(const Triangle& t, const ThreeFaces& across) const
{
  if (outward_.empty()) return false;
  const Side side = side_by_normals(t);
  if (side == Side::torn) return true;
  if (side == Side::unclear) return false;
  for (std::size_t e = 0; e < 3; ++e) {
    if (across[e] == no_face) continue;
    const Side other = side_by_normals(face_[across[e]].corner);
    if (other == Side::unclear || other == Side::torn) continue;
    // Seen from their outsides, two faces run along their common edge in opposite directions.
    if ((side == other) == runs_along(across[e], t[e], t[(e + 1) % 3])) return true;
  }
  return false;
}

std::size_t TriangleComplex::remove_opposed()
{
  std::vector<std::uint32_t> opposed;
  for (const std::uint32_t f : faces())
    if (const Side side = side_by_normals(oriented(f)); side == Side::back || side == Side::torn) opposed.push_back(f);
  for (const std::uint32_t f : opposed) remove(f);
  return opposed.size();
}

}  // namespace pds
