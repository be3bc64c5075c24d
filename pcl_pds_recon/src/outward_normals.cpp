// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/outward_normals.h>

#include <cmath>

#include "view_from_above.h"

namespace pds
{
namespace
{

using Eigen::Vector3d;

/** \brief True if the normals of bordering cells agree wherever the surface is smooth between them. */
bool are_oriented(const std::vector<Vector3d>& outward, const SeedGeometry& seeds, const std::vector<SeedPair>& pairs)
{
  constexpr double smooth = 0.94;       // cosine between the planes of two cells: 20 degrees
  constexpr double beside = 0.5;        // cosine between the edge and a normal: not one sheet above another
  constexpr double most_turned = 0.02;  // of the smooth pairs; noisy scans have 0.001, unoriented normals 0.5
  std::size_t smooth_pairs = 0;
  std::size_t turned = 0;
  for (const SeedPair& p : pairs) {
    const Vector3d edge = (seeds.position[p.b] - seeds.position[p.a]).normalized();
    if (std::abs(seeds.normal[p.a].dot(seeds.normal[p.b])) < smooth || std::abs(edge.dot(seeds.normal[p.a])) > beside)
      continue;
    const double agreement = outward[p.a].dot(outward[p.b]);
    smooth_pairs += agreement != 0 ? 1 : 0;
    turned += agreement < 0 ? 1 : 0;
  }
  return static_cast<double>(turned) <= most_turned * static_cast<double>(smooth_pairs);
}

/** \brief What leads outside from a point: its normal or, if the cloud has none, the line of sight to the sensor. */
Vector3d outward_direction(const PointCloudView& cloud, std::size_t point)
{
  const Vector3d direction =
      cloud.normals ? cloud.normals[point] : Vector3d(cloud.viewpoints[point] - cloud.positions[point]);
  const double length = direction.norm();
  return std::isfinite(length) && length > 0 ? Vector3d(direction / length) : Vector3d(0, 0, 0);
}

}  // namespace

std::vector<Vector3d> outward_normals(const PointCloudView& cloud,
                                      const OrderedPoints& points,
                                      const SeedGeometry& seeds,
                                      const GeodesicVoronoi& voronoi,
                                      const Parallel& parallel)
{
  if (!cloud.normals && !cloud.viewpoints && !cloud.sensor_origin) return outward_from_above(seeds, parallel);
  if (!cloud.normals && !cloud.viewpoints) return {};
  constexpr std::size_t block = 256;
  constexpr double least_mean = 0.3;  // of unit normals; below it they point all ways, or lines of sight graze
  std::vector<Vector3d> outward(seeds.position.size());
  parallel.each(outward.size(), block, [&](std::size_t s) {
    Vector3d mean = Vector3d::Zero();
    for (std::size_t i = voronoi.cell_begin[s]; i < voronoi.cell_begin[s + 1]; ++i)
      mean += outward_direction(cloud, points.input_index[voronoi.cell_point[i]]);
    mean /= static_cast<double>(voronoi.cell_begin[s + 1] - voronoi.cell_begin[s]);
    // A line of sight only tells which of its two sides a surface shows.
    if (!cloud.normals) mean = mean.dot(seeds.normal[s]) * seeds.normal[s];
    outward[s] = mean.norm() > least_mean ? Vector3d(mean.normalized()) : Vector3d(0, 0, 0);
  });
  if (!are_oriented(outward, seeds, voronoi.pairs)) outward.clear();
  return outward;
}

}  // namespace pds
