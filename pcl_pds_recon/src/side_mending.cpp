// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/side_mending.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace pds
{
namespace
{

using Eigen::Vector3d;

constexpr double least_upright =
    0.3;                           // cosine between a cell's normal and the mean of its faces': steeper tells no side
constexpr double same_side = 0.0;  // cosine: what is filled in is not beyond a right angle off its corners' normals

Vector3d area_vector(const Triangle& t, const std::vector<Vector3d>& position)
{
  return (position[t[1]] - position[t[0]]).cross(position[t[2]] - position[t[0]]);
}

std::vector<Triangle> triangles_of(const TriangleComplex& complex)
{
  std::vector<Triangle> triangles;
  for (const std::uint32_t f : complex.faces()) triangles.push_back(complex.oriented(f));
  return triangles;
}

/** \brief The normal of each seed's cell, on the side that the faces at the seed face in the mean; 0 where they do not
 * tell. */
std::vector<Vector3d> shown_normals(const std::vector<Triangle>& triangles, const SeedGeometry& seeds)
{
  std::vector<Vector3d> shown(seeds.position.size(), Vector3d::Zero());
  for (const Triangle& t : triangles)
    for (const std::uint32_t v : t) shown[v] += area_vector(t, seeds.position);
  for (std::size_t v = 0; v < shown.size(); ++v) {
    const double along = shown[v].dot(seeds.normal[v]);
    if (std::abs(along) > least_upright * shown[v].norm())
      shown[v] = along < 0 ? Vector3d(-seeds.normal[v]) : seeds.normal[v];
    else
      shown[v] = Vector3d::Zero();
  }
  return shown;
}

}  // namespace

std::size_t mend_sides(TriangleComplex& complex,
                       const SeedGeometry& seeds,
                       const BorderingCells& bordering,
                       const FillLimits& limits)
{
  const std::vector<Triangle> before = triangles_of(complex);
  complex.believe_normals(shown_normals(before, seeds));
  const std::size_t against = complex.remove_opposed();
  if (against > 0) {
    FillLimits on_side = limits;
    on_side.facing = same_side;
    on_side.join_rims = false;
    fill_holes(complex, seeds, bordering, {}, on_side);
    fill_gaps(complex, seeds, bordering, on_side);
  }
  complex.believe_normals({});
  if (against == 0) return 0;
  // What is against the sides, and what hung on by it, is still better than nothing.
  for (const Triangle& t : before) complex.add(t, limits.smallest_angle);
  FillLimits as_before = limits;
  as_before.join_rims = false;
  fill_holes(complex, seeds, bordering, {}, as_before);
  fill_gaps(complex, seeds, bordering, as_before);
  return against;
}

}  // namespace pds
