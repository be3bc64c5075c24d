// SPDX-License-Identifier: BSD-3-Clause
#include "crease_cover.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace pds_test
{
namespace
{

using Eigen::Vector3d;

double squared_distance(const Vector3d& point, const Vector3d& from, const Vector3d& to)
{
  const Vector3d way = to - from;
  const double along = (point - from).dot(way) / way.squaredNorm();
  return (from + std::clamp(along, 0.0, 1.0) * way - point).squaredNorm();
}

bool is_covered(const Vector3d& point, const Creases& cover, double distance)
{
  for (std::size_t i = 0; i < cover.from.size(); ++i)
    if (squared_distance(point, cover.from[i], cover.to[i]) <= distance * distance) return true;
  return false;
}

}  // namespace

Creases find_creases(const Triangles& triangles, const std::vector<Vector3d>& position, double least_turn)
{
  const double cosine = std::cos(least_turn * std::acos(-1.0) / 180);
  std::map<std::pair<std::uint32_t, std::uint32_t>, Vector3d> normal_beside;
  for (const auto& t : triangles)
    for (std::size_t side = 0; side < 3; ++side)
      normal_beside[{t[side], t[(side + 1) % 3]}] =
          (position[t[1]] - position[t[0]]).cross(position[t[2]] - position[t[0]]).normalized();
  Creases creases;
  for (const auto& [edge, normal] : normal_beside) {
    const auto other = normal_beside.find({edge.second, edge.first});
    if (edge.first > edge.second || other == normal_beside.end() || normal.dot(other->second) >= cosine) continue;
    creases.from.push_back(position[edge.first]);
    creases.to.push_back(position[edge.second]);
  }
  return creases;
}

Creases find_rims(const Triangles& triangles, const std::vector<Vector3d>& position)
{
  std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
  for (const auto& t : triangles)
    for (std::size_t side = 0; side < 3; ++side) edges.emplace(t[side], t[(side + 1) % 3]);
  Creases rims;
  for (const auto& [from, to] : edges) {
    if (edges.count({to, from}) != 0) continue;
    rims.from.push_back(position[from]);
    rims.to.push_back(position[to]);
  }
  return rims;
}

double covered_share(const Creases& creases, const Creases& cover, double distance)
{
  double all = 0;
  double covered = 0;
  for (std::size_t i = 0; i < creases.from.size(); ++i) {
    const Vector3d way = creases.to[i] - creases.from[i];
    const auto steps = static_cast<int>(std::ceil(4 * way.norm() / distance));
    const double length = way.norm() / steps;
    for (int step = 0; step < steps; ++step) {
      all += length;
      if (is_covered(creases.from[i] + (step + 0.5) / steps * way, cover, distance)) covered += length;
    }
  }
  return covered / all;
}

}  // namespace pds_test
