// SPDX-License-Identifier: BSD-3-Clause
#include "cloud_distance.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include "mesh_fans.h"

namespace pds
{
namespace
{

using Eigen::Vector3d;

double squared_distance_to_segment(const Vector3d& p, const Vector3d& a, const Vector3d& b)
{
  const Vector3d along = b - a;
  const double length2 = along.squaredNorm();
  const double share = length2 > 0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  return (p - a - share * along).squaredNorm();
}

double squared_distance_to_triangle(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const Vector3d normal = (b - a).cross(c - a);
  const bool inside = (b - a).cross(p - a).dot(normal) >= 0 && (c - b).cross(p - b).dot(normal) >= 0 &&
                      (a - c).cross(p - c).dot(normal) >= 0;
  if (inside && normal.squaredNorm() > 0) {
    const double height = (p - a).dot(normal);
    return height * height / normal.squaredNorm();
  }
  return std::min({squared_distance_to_segment(p, a, b), squared_distance_to_segment(p, b, c),
                   squared_distance_to_segment(p, c, a)});
}

/** \brief For each seed the faces at it and at the seeds that it has a face with. */
std::vector<std::vector<std::uint32_t>> surroundings(const std::vector<Triangle>& triangles,
                                                     std::size_t seed_count,
                                                     const Parallel& parallel)
{
  constexpr std::size_t block = 512;
  const MeshFans fans(triangles, seed_count, parallel);
  std::vector<std::vector<std::uint32_t>> faces(seed_count);
  parallel.each(seed_count, block, [&](std::size_t s) {
    for (const std::uint32_t* f = fans.begin(s); f != fans.end(s); ++f)
      for (const std::uint32_t v : triangles[*f]) faces[s].insert(faces[s].end(), fans.begin(v), fans.end(v));
    std::sort(faces[s].begin(), faces[s].end());
    faces[s].erase(std::unique(faces[s].begin(), faces[s].end()), faces[s].end());
  });
  return faces;
}

}  // namespace

double distance_of_share(const PointCloudView& cloud,
                         const OrderedPoints& points,
                         const PoissonDiskSampling& sampling,
                         const std::vector<Vector3d>& position,
                         const std::vector<Triangle>& triangles,
                         double share,
                         const Parallel& parallel)
{
  constexpr std::size_t block = 4096;
  const std::vector<std::vector<std::uint32_t>> faces = surroundings(triangles, position.size(), parallel);
  const double to_input = sampling.radius * points.unit;
  std::vector<float> distance(points.rank_of_input.size());
  parallel.each(distance.size(), block, [&](std::size_t i) {
    const std::uint32_t rank = points.rank_of_input[i];
    if (rank == no_rank) return;
    const Vector3d p = (cloud.positions[i] - points.origin) / to_input;
    double nearest2 = std::numeric_limits<double>::infinity();
    for (const std::uint32_t f : faces[sampling.nearest[rank].seed[0]]) {
      const Triangle& t = triangles[f];
      nearest2 = std::min(nearest2, squared_distance_to_triangle(p, position[t[0]], position[t[1]], position[t[2]]));
    }
    distance[i] = static_cast<float>(std::sqrt(nearest2) * to_input);
  });
  std::size_t kept = 0;  // points that are not finite and outliers do not count
  for (std::size_t i = 0; i < distance.size(); ++i)
    if (points.rank_of_input[i] != no_rank) distance[kept++] = distance[i];
  distance.resize(kept);
  if (distance.empty()) return 0;
  const auto place = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(distance.size()))) - 1;
  std::nth_element(distance.begin(), distance.begin() + place, distance.end());
  return static_cast<double>(distance[static_cast<std::size_t>(place)]);
}

}  // namespace pds
