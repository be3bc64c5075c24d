// SPDX-License-Identifier: BSD-3-Clause
#include <pcl_pds_recon/outward_normals.h>

#include <cmath>

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

}  // namespace

std::vector<Vector3d> outward_normals(const PointCloudView& cloud,
                                      const OrderedPoints& points,
                                      const SeedGeometry& seeds,
                                      const GeodesicVoronoi& voronoi,
                                      const Parallel& parallel)
{
  if (!cloud.normals) return {};
  constexpr std::size_t block = 256;
  constexpr double least_mean = 0.3;  // of unit normals; below it they point all ways
  std::vector<Vector3d> outward(seeds.position.size());
  parallel.each(outward.size(), block, [&](std::size_t s) {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = voronoi.cell_begin[s]; i < voronoi.cell_begin[s + 1]; ++i) {
      const Vector3d normal = cloud.normals[points.input_index[voronoi.cell_point[i]]];
      const double length = normal.norm();
      if (std::isfinite(length) && length > 0) sum += normal / length;
    }
    const auto count = static_cast<double>(voronoi.cell_begin[s + 1] - voronoi.cell_begin[s]);
    outward[s] = sum.norm() > least_mean * count ? Vector3d(sum.normalized()) : Vector3d(0, 0, 0);
  });
  if (!are_oriented(outward, seeds, voronoi.pairs)) outward.clear();
  return outward;
}

}  // namespace pds
